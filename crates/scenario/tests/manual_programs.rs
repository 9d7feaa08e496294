//! The programs under `scenarios/programs` are those of the manual: statement for statement, with corrected
//! line breaks and with variable tables added as sections.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use std::fs;
use std::path::Path;

/// A-3-3, ST Programming, as printed, without comments (manual, lines 5254 to 5287 of its text).
const A_3_3: &str = "
IF NXBus_N1_NX_Unit_I_O_Data_Active_Status=TRUE AND NXBus_N1_NX_Unit_Error_Status=F
ELSE AND N1_Data_from_EtherCAT_Master_to_CPU_Unit_Valid=TRUE THEN
    M_to_C_Data_is_Valid:=TRUE;
ELSE
    M_to_C_Data_is_Valid:=FALSE;
END_IF;
IF NXBus_N1_NX_Unit_I_O_Data_Active_Status=TRUE AND NXBus_N1_NX_Unit_Error_Status=F
ELSE AND N1_Data_from_CPU_Unit_to_EtherCAT_Master_Valid=TRUE THEN
    C_to_M_Data_is_Valid:=TRUE;
ELSE
    C_to_M_Data_is_Valid:=FALSE;
END_IF;
IF M_to_C_Data_is_Valid=TRUE AND C_to_M_Data_is_Valid=TRUE THEN
    MemCopy(N1_UINTs_01_M_to_C[0], N1_UINTs_01_C_to_M[0], 10#15);
END_IF;
";

/// A-4-3, ST Programming (lines 5396 to 5428).
const A_4_3: &str = "
IF _EC_PDSlavTbl[1]=TRUE AND E001_Data_from_CPU_Unit_to_EtherCAT_Master_Valid=TRUE
THEN
    CPU_Status:=UDINT_TO_DWORD(E001_UDINT_01_C_to_M);
    Pulse_CPU:=TestABit(CPU_Status,16#0);
END_IF;
R_TRIG_Pulse_CPU001(Pulse_CPU, Trigger);
RS_RunMode(Trigger, FALSE, CPUUnit_RunMode);
R_TRIG_Pulse_CPU002(Pulse_CPU, WDT_Refresh);
IF _EC_PDslavTbl[1]=TRUE AND E001_Data_from_CPU_Unit_to_EtherCAT_Master_Valid=TRUE
THEN
    CPU_WDT(TRUE, T#20ms, WDT_Refresh, WDTTimeUp, ElapsedTime);
    IF WDTTimeUp = TRUE THEN
        SetAlarm(16#101, ElapsedTime, _EC_PDslavTbl[1]);
        CPUUnit_RunMode:=FALSE;
    END_IF;
END_IF;
";

/// A-4-4, ST Programming (lines 5481 to 5500).
const A_4_4: &str = "
CPU_Pulse := NOT CPU_Pulse;
IF NXBus_N1_NX_Unit_I_O_Data_Active_Status AND NOT NXBus_N1_NX_Unit_Error_Status AND
D N1_Data_from_CPU_Unit_to_EtherCAT_Master_Valid THEN
  OutABit(CPU_Status,16#0,CPU_Pulse);
  N1_UDINT_01_C_to_M:=DWORD_TO_UDINT(CPU_Status);
END_IF;
";

/// Words that the print splits at a line break, and the words.
const MENDED: [(&str, &str); 2] = [("=F\nELSE AND", "=FALSE AND"), ("AND\nD N1_Data", "AND N1_Data")];

#[test]
fn the_statements_are_the_manuals() {
    for (file, printed) in [("a-3-3.st", A_3_3), ("a-4-3.st", A_4_3), ("a-4-4.st", A_4_4)] {
        let mended =
            MENDED.iter().fold(printed.to_owned(), |text, (broken, whole)| text.replace(broken, whole));
        assert_eq!(statements_of(file), words(&mended), "{file}");
    }
}

/// The words of the statements of a program: the part after its variables, without comments.
fn statements_of(file: &str) -> Vec<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/programs").join(file);
    let text = fs::read_to_string(path).expect("a program");
    let (_, body) = text.rsplit_once("END_VAR").expect("sections of variables");
    words(body.trim_end().trim_end_matches("END_PROGRAM"))
}

fn words(text: &str) -> Vec<String> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(str::split_whitespace).map(str::to_owned).collect()
}
