//! Conditions in conditions. A condition on what is not there is neither true nor false, and decides only what the
//! others leave open. So does one on what a unit without power does not show: `not` of it does not hold.

use super::seen::Seen;
use crate::model::Condition;

type Check = Result<(), Seen>;

/// True if the part is false; a part that is neither true nor false stays so, as does one that cannot be read.
pub(super) fn not(part: &Condition, checked: Check) -> Check {
    match checked {
        Ok(()) => Err(format!("`{part}` holds").into()),
        Err(seen) if seen.is_contrary() => Ok(()),
        Err(seen) => Err(seen),
    }
}

/// False if a part is false, which is named; else neither true nor false if a part is.
pub(super) fn all_of(parts: &[Condition], mut check: impl FnMut(&Condition) -> Check) -> Check {
    let mut open: Option<Seen> = None;
    for part in parts {
        match check(part) {
            Ok(()) => {}
            Err(seen) if seen.is_contrary() => return Err(seen.of(part)),
            Err(seen) if seen.is_false() && open.as_ref().is_none_or(|open| !open.is_false()) => {
                open = Some(seen.of(part));
            }
            Err(seen) => open = open.or(Some(seen.of(part))),
        }
    }
    open.map_or(Ok(()), Err)
}

/// True if a part is true; else neither true nor false if a part is. Otherwise all of them are named.
pub(super) fn any_of(parts: &[Condition], mut check: impl FnMut(&Condition) -> Check) -> Check {
    let mut seen = Vec::new();
    for part in parts {
        match check(part) {
            Ok(()) => return Ok(()),
            Err(other) => seen.push(other.of(part)),
        }
    }
    Err(Seen::together(&seen))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Condition::{AllOf, AnyOf, Cycles, Not};

    /// True, false, or neither.
    type Truth = Option<bool>;

    const TRUTHS: [Truth; 3] = [Some(true), Some(false), None];

    /// The truth of each condition is that of the table, by its number of cycles.
    fn truth(condition: &Condition, table: &[Truth]) -> Truth {
        let checked = evaluate(condition, table);
        match checked {
            Ok(()) => Some(true),
            Err(seen) => seen.is_false().then_some(false),
        }
    }

    fn evaluate(condition: &Condition, table: &[Truth]) -> Check {
        if let Cycles { at_least } = condition {
            return match table[*at_least as usize] {
                Some(true) => Ok(()),
                Some(false) => Err("false".to_owned().into()),
                None => Err(Seen::not_there("not there")),
            };
        }
        if let Not(part) = condition {
            return not(part, evaluate(part, table));
        }
        if let AllOf(parts) = condition {
            return all_of(parts, |part| evaluate(part, table));
        }
        let AnyOf(parts) = condition else { panic!("{condition}") };
        any_of(parts, |part| evaluate(part, table))
    }

    fn part(number: u64) -> Condition {
        Cycles { at_least: number }
    }

    /// Kleene's three-valued logic, written independently: true is 1, neither is 0, false is -1.
    #[test]
    fn the_logic_is_that_of_three_values() {
        let number = |truth: Truth| truth.map_or(0, |truth| if truth { 1 } else { -1 });
        for a in TRUTHS {
            assert_eq!(number(truth(&Not(Box::new(part(0))), &[a])), -number(a));
            for b in TRUTHS {
                for c in TRUTHS {
                    let (table, parts) = ([a, b, c], || vec![part(0), part(1), part(2)]);
                    let numbers = [a, b, c].map(number);
                    let [least, most] = [numbers.iter().min(), numbers.iter().max()];
                    assert_eq!(Some(&number(truth(&AllOf(parts()), &table))), least, "all of {table:?}");
                    assert_eq!(Some(&number(truth(&AnyOf(parts()), &table))), most, "any of {table:?}");
                    // De Morgan.
                    let not_any = Not(Box::new(AnyOf(parts())));
                    let all_not = AllOf(parts().into_iter().map(|part| Not(Box::new(part))).collect());
                    assert_eq!(truth(&not_any, &table), truth(&all_not, &table));
                }
            }
        }
    }

    #[test]
    fn the_part_that_decides_is_named() {
        let words = |condition: &Condition, table: &[Truth]| {
            evaluate(condition, table).map_err(|seen| seen.to_string())
        };
        let [yes, no, open] = TRUTHS;
        let all = AllOf(vec![part(0), part(1), part(2)]);
        assert_eq!(words(&all, &[yes, open, no]), Err("`2 cycles are done`: false".to_owned()));
        assert_eq!(words(&all, &[yes, open, open]), Err("`one cycle is done`: not there".to_owned()));
        let any = AnyOf(vec![part(0), Not(Box::new(part(1)))]);
        let seen = "`0 cycles are done`: false; `not (one cycle is done)`: `one cycle is done` holds";
        assert_eq!(words(&any, &[no, yes]), Err(seen.to_owned()));
    }
}
