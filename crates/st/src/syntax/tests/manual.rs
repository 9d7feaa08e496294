//! The programs of the manual, A-3-3, A-4-3 and A-4-4, with corrected line breaks, as far as their forms are supported.

use super::read;

#[test]
fn the_forms_of_the_manual_are_read() {
    let file = read(
        "// If I/O data in the NX Unit is available\r
IF NXBus_N1_NX_Unit_I_O_Data_Active_Status=TRUE AND NXBus_N1_NX_Unit_Error_Status=FALSE\r
AND N1_Data_from_EtherCAT_Master_to_CPU_Unit_Valid=TRUE THEN\r
    M_to_C_Data_is_Valid:=TRUE;\r
ELSE\r
    M_to_C_Data_is_Valid:=FALSE;\r
END_IF;\r
MemCopy(N1_UINTs_01_M_to_C[0], N1_UINTs_01_C_to_M[0], 10#15);
CPU_Status:=UDINT_TO_DWORD(E001_UDINT_01_C_to_M);
Pulse_CPU:=TestABit(CPU_Status,16#0);
R_TRIG_Pulse_CPU001(Pulse_CPU, Trigger);
RS_RunMode(Trigger, FALSE, CPUUnit_RunMode);
IF _EC_PDslavTbl[1]=TRUE AND E001_Data_from_CPU_Unit_to_EtherCAT_Master_Valid=TRUE
THEN
    CPU_WDT(TRUE, T#20ms, WDT_Refresh, WDTTimeUp, ElapsedTime);
    IF WDTTimeUp = TRUE THEN
        SetAlarm(16#101, ElapsedTime, _EC_PDslavTbl[1]);
    END_IF;
END_IF;
CPU_Pulse := NOT CPU_Pulse;
OutABit(CPU_Status,16#0,CPU_Pulse);
",
    );
    assert_eq!(file.units.len(), 1);
    assert_eq!(file.units[0].name.text, "");
    assert_eq!(file.units[0].body.len(), 9);
}
