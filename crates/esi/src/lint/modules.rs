//! Slots and modules (ETG.5001).

use std::collections::BTreeMap;

use super::finding::Report;
use super::rules;
use crate::file::{DeviceElement, ModuleElement, SlotElement};

/// The modules of a file by ident and class, each with whether an index of it depends on the slot.
#[derive(Default)]
pub(crate) struct Modules<'a> {
    idents: BTreeMap<u32, bool>,
    classes: BTreeMap<&'a str, bool>,
}

impl<'a> Modules<'a> {
    /// Those of a file. Modules that no number distinguishes are reported.
    pub(crate) fn of(modules: &'a [ModuleElement], report: &dyn Report) -> Self {
        let mut known = Self::default();
        for module in modules {
            let depends = module.pdos().any(|pdo| pdo.index.depends_on_slot);
            if known.idents.insert(module.ident, depends).is_some() {
                let message = format!("the module ident 0x{:08X} is there before", module.ident);
                report.report(rules::MODULE_TWICE, module.place, message);
            }
            *known.classes.entry(&module.class).or_default() |= depends;
        }
        known
    }

    /// Whether an index of a module for this slot depends on the slot.
    fn depend_on(&self, slot: &SlotElement) -> bool {
        let by_ident = slot.idents.iter().filter_map(|(ident, _)| self.idents.get(ident));
        let by_class = slot.classes.iter().filter_map(|class| self.classes.get(class.as_str()));
        by_ident.chain(by_class).any(|depends| *depends)
    }
}

pub(super) fn check(device: &DeviceElement, modules: &Modules<'_>, report: &dyn Report) {
    let Some(slots) = &device.slots else { return };
    for slot in &slots.slots {
        check_names(slot, modules, report);
    }
    let required: u32 = slots.slots.iter().map(|slot| u32::from(slot.min_instances)).sum();
    if let Some(max) = slots.max_count.filter(|max| u32::from(*max) < required) {
        let message = format!("there are at most {max} slots, but {required} must have a module");
        report.report(rules::SLOT_COUNT, slots.place, message);
    }
    let depends = slots.slots.iter().any(|slot| modules.depend_on(slot));
    if slots.pdo_increment.is_none() && slots.count() > 1 && depends {
        let message =
            "the indexes of modules depend on the slot, but there is no SlotPdoIncrement; read as 0";
        report.report(rules::SLOT_INCREMENT, slots.place, message.into());
    }
}

fn check_names(slot: &SlotElement, modules: &Modules<'_>, report: &dyn Report) {
    for (ident, _) in slot.idents.iter().filter(|(ident, _)| !modules.idents.contains_key(ident)) {
        let message = format!("the slot names the module 0x{ident:08X}, which is not in this file");
        report.report(rules::MODULE_UNKNOWN, slot.place, message);
    }
    for class in slot.classes.iter().filter(|class| !modules.classes.contains_key(class.as_str())) {
        let class = user_file::shown(class);
        let message = format!("the slot names the module class `{class}`, which is not in this file");
        report.report(rules::MODULE_UNKNOWN, slot.place, message);
    }
}
