//! The blocks of the prelude, by programs.

use crate::host::NoHost;
use crate::program::compile;

#[test]
fn the_prelude_compiles() {
    let source = "PROGRAM Main VAR t : TON; q : BOOL; a : ARRAY[0..9] OF UINT; b : ARRAY[0..9] OF UINT; s : STRING; END_VAR
        t(TRUE, T#5ms, q);
        MemCopy(a[0], b[0], 10#5);
        s := CONCAT('a', INT_TO_STRING(-5), TIME_TO_STRING(t.ET));
        SetAlarm(16#101, t.ET, q);
        END_PROGRAM";
    let program = compile(source, &[]).unwrap_or_else(|problems| panic!("{problems}"));
    let mut instance = program.start();
    instance.scan(0, 1000, &mut NoHost).unwrap();
    instance.scan(6_000_000, 1000, &mut NoHost).unwrap();
    assert_eq!(instance.value("q").as_deref(), Some("TRUE"));
    assert_eq!(instance.value("s").as_deref(), Some("'a-5T#5ms'"));
}
