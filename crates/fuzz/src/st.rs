//! Programs in Structured Text: from a grammar, and damaged real ones.
//!
//! A refused program has places of mistakes; an accepted program executes its scans within its budget, and two
//! runs are equal.

mod grammar;

use st::{Global, Instance, NoHost, PROBLEMS_MAX, Program};

use crate::fuzzer::{Checked, Fuzzer, Grain, Limits};
use crate::mistakes::{check_number, check_place, check_words};
use crate::random::Random;
use crate::real_files::Seeds;
use crate::text::damaged;

pub(crate) const FUZZER: Fuzzer = Fuzzer {
    name: "st",
    extension: ".st",
    seeds: || Seeds::of(&["tests/fuzz/st", "crates/st/tests/programs", "scenarios", "tests/cases"], ".st"),
    generate: |seeds, random| generate(seeds, random).into_bytes(),
    check,
    limits: Limits {
        milliseconds: 2_000,
        milliseconds_per_kib: 100,
        memory_kib: 64 << 10,
        memory_per_byte: 8_192,
    },
    grains: &[Grain::Lines, Grain::Clauses, Grain::Words, Grain::Bytes],
};

/// Number of scans of an accepted program, and maximum number of statements of each.
const SCANS: u64 = 4;
const BUDGET: u64 = 2_000;

fn check(input: &[u8]) -> Checked {
    let Ok(text) = std::str::from_utf8(input) else { return Ok("no text") };
    let globals = globals();
    let judged = st::judge(text, &globals);
    let program = match st::compile(text, &globals) {
        Ok(program) => program,
        Err(problems) => {
            check_number(problems.list().len(), PROBLEMS_MAX)?;
            for problem in problems.list() {
                let place = problems.place(problem);
                check_place(text, &place.range, place.line, place.column)?;
                check_words(&problem.message)?;
            }
            return Ok("refused");
        }
    };
    if let Err(problems) = judged {
        return Err(format!("it can run, and is judged wrong: {problems}"));
    }
    scans(&program, text)?;
    Ok("accepted")
}

fn scans(program: &Program, text: &str) -> Result<(), String> {
    let (mut one, mut other) = (program.start(), program.start());
    let mut stopped = false;
    for scan in 0..SCANS {
        let now_ns = scan * 1_000_000;
        load(&mut one, program, scan);
        load(&mut other, program, scan);
        let result = one.scan(now_ns, BUDGET, &mut NoHost);
        if one.used() > BUDGET {
            return Err(format!("{} statements of {BUDGET}", one.used()));
        }
        if result != other.scan(now_ns, BUDGET, &mut NoHost)
            || outputs(&one, program) != outputs(&other, program)
        {
            return Err(format!("scan {scan} goes two ways"));
        }
        if let Err(reason) = result {
            stopped = true;
            text.get(reason.span.range()).ok_or_else(|| format!("{reason:?} is outside the text"))?;
        }
    }
    // The values that a changed program takes over, and those that a restart keeps.
    let next = one.succeeded_by(program.start());
    one.restart();
    if !stopped && outputs(&next, program).len() != outputs(&one, program).len() {
        return Err("a successor has other outputs".to_owned());
    }
    Ok(())
}

fn load(instance: &mut Instance, program: &Program, scan: u64) {
    for external in program.externals() {
        let bytes = vec![scan as u8; external.size_bytes()];
        instance.load(external, &bytes);
    }
}

fn outputs(instance: &Instance, program: &Program) -> Vec<u8> {
    let mut outputs = Vec::new();
    for external in program.externals().iter().filter(|external| external.written) {
        let at = outputs.len();
        outputs.resize(at + external.size_bytes(), 0);
        instance.store(external, &mut outputs[at..]);
    }
    outputs
}

/// Device variables like those of a unit.
fn globals() -> Vec<Global> {
    let global = |name: &str, type_name: &str, writable| Global {
        name: name.to_owned(),
        at: None,
        type_name: type_name.to_owned(),
        writable,
        constant: None,
    };
    vec![
        global("N1_UINTs_01_M_to_C", "ARRAY[0..14] OF UINT", false),
        global("N1_UINTs_01_C_to_M", "ARRAY[0..14] OF UINT", true),
        global("N1_BYTES_01_C_to_M", "ARRAY[0..9] OF BYTE", true),
        global("N1_UDINT_01_C_to_M", "UDINT", true),
        global("N1_IN_Port_Link_ON", "BOOL", false),
    ]
}

fn generate(seeds: &Seeds, random: &mut Random) -> String {
    let text = if random.once_in(2) && !seeds.texts.is_empty() {
        random.one_of(&seeds.texts).clone()
    } else {
        grammar::program(random)
    };
    if random.once_in(3) { text } else { damaged(&text, grammar::WORDS, &seeds.texts, random) }
}
