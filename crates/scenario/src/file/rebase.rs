//! Paths of a prelude, as seen from the scenario.

use std::path::Path;

use plc::Builtin;

use crate::model::{CpuOrder, Order, Paths, Script, ScriptStep, ScriptUnit, UnitOrder};

/// Changes all paths of a file in this folder to paths from the scenario.
pub(super) fn rebase(script: &mut Script, folder: &Path) {
    if folder.as_os_str().is_empty() {
        return;
    }
    let seen = |path: &mut String| {
        if Builtin::named(path).is_none() {
            *path = folder.join(&*path).display().to_string();
        }
    };
    script.capture.iter_mut().for_each(seen);
    script.master.iter_mut().for_each(|master| each_path(&mut master.program, seen));
    for unit in &mut script.units {
        match unit {
            ScriptUnit::File(path) => seen(path),
            ScriptUnit::FileWithProgram(unit) => {
                seen(&mut unit.file);
                unit.program.iter_mut().for_each(|program| each_path(program, seen));
            }
            ScriptUnit::Keys(table) => {
                let program = table.get_mut("cpu").and_then(|cpu| cpu.get_mut("program"));
                program.into_iter().for_each(|program| each_text(program, seen));
                each_csv_file(table, seen);
            }
        }
    }
    each_order(&mut script.steps, &mut |order| match order {
        Order::Cpu(CpuOrder::Load { program, .. }) => seen(program),
        Order::Unit(UnitOrder::LoadSii { file, .. } | UnitOrder::Replace { file, .. }) => seen(file),
        Order::Master(_) | Order::Unit(_) | Order::Cpu(_) | Order::Line(_) | Order::Expect(_) => {}
    });
}

fn each_path(paths: &mut Paths, seen: impl Fn(&mut String)) {
    match paths {
        Paths::One(path) => seen(path),
        Paths::Several(paths) => paths.iter_mut().for_each(seen),
    }
}

/// The files of behaviours.
fn each_csv_file(unit: &mut toml::Table, seen: impl Fn(&mut String) + Copy) {
    let behaviours = unit.get_mut("behaviour").and_then(toml::Value::as_table_mut);
    for (_, behaviour) in behaviours.into_iter().flatten() {
        let file = behaviour.get_mut("csv").and_then(|csv| csv.get_mut("file"));
        file.into_iter().for_each(|file| each_text(file, seen));
    }
}

fn each_text(value: &mut toml::Value, seen: impl Fn(&mut String) + Copy) {
    match value {
        toml::Value::String(text) => seen(text),
        toml::Value::Array(values) => values.iter_mut().for_each(|value| each_text(value, seen)),
        toml::Value::Integer(_)
        | toml::Value::Float(_)
        | toml::Value::Boolean(_)
        | toml::Value::Datetime(_)
        | toml::Value::Table(_) => {}
    }
}

fn each_order(steps: &mut [ScriptStep], change: &mut impl FnMut(&mut Order)) {
    for step in steps {
        match step {
            ScriptStep::Step(step) => change(&mut step.order),
            ScriptStep::Random(_) => {}
            ScriptStep::Group(group) => {
                group.members.sequences_mut().iter_mut().for_each(|steps| each_order(steps, change));
            }
        }
    }
}
