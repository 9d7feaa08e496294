//! What the cases of a campaign have met, and what none of them has: text for people, codes for programs.

use scenario::{Fact, FactKind, Met};

/// The facts of a case, for its JSON line: `event 85000000`.
pub(super) fn codes(met: &Met) -> Vec<String> {
    met.iter().map(code).collect()
}

fn code(fact: Fact) -> String {
    format!("{} {fact}", fact.kind().words().0)
}

/// A line for each kind, then one for each fact that no case has met.
pub(super) fn text(met: &Met, possible: &Met) -> String {
    let is_met = |fact: &Fact| met.has(*fact);
    let mut text = format!("coverage: {} of {}\n", possible.iter().filter(is_met).count(), possible.count());
    for kind in FactKind::ALL {
        let of_kind: Vec<Fact> = possible.iter().filter(|fact| fact.kind() == kind).collect();
        if of_kind.is_empty() {
            continue;
        }
        let count = of_kind.iter().filter(|fact| is_met(fact)).count();
        text.push_str(&format!("        {:<16}  {count} of {}\n", kind.words().1, of_kind.len()));
        for fact in of_kind.into_iter().filter(|fact| !is_met(fact)) {
            let name = fact.name().map(|name| format!(" {name}")).unwrap_or_default();
            text.push_str(&format!("            not met: {}{name}\n", code(fact)));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use scenario::{Recording, Scenario};

    use super::*;

    #[test]
    fn what_a_case_meets_is_counted_and_the_rest_is_named() {
        let text = "title = \"t\"\nsteps = [{ master = \"take unit 1 to PRE-OP\" }, { expect = \"unit 1 is in PRE-OP\", within = \"1s\" }]\n";
        let scenario = Scenario::parse(text, |name| Err(name.to_owned())).unwrap();
        let report = scenario.replay(1, Recording::new(false, false).with_met());
        let met = report.recording.met().unwrap();
        let codes = codes(met);
        for code in ["state PRE-OP", "transition IP", "register 0x0130"] {
            assert!(codes.iter().any(|known| known == code), "{codes:?}");
        }
        let text = super::text(met, &Met::possible(&scenario));
        for line in [
            "        states            2 of 8\n",
            "            not met: transition PS\n",
            "            not met: event 85000000 Process Data WDT Error\n",
            "        events            0 of 38\n",
        ] {
            assert!(text.contains(line), "`{line}` is not in:\n{text}");
        }
        // Units begin in INIT, and no model has code 0x0023.
        for absent in ["not met: transition IP\n", "not met: state INIT\n", "AL status code 0x0023"] {
            assert!(!text.contains(absent), "{text}");
        }
        assert!(scenario.replay(1, Recording::new(false, false)).recording.met().is_none());
    }
}
