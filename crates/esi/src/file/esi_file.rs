//! A whole file: its devices and modules, and the findings.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::device::DeviceElement;
use super::dictionary::DictionaryElement;
use super::document;
use super::element::Element;
use super::profile::ProfileElement;
use super::read_error::ReadError;
use super::reading::{self, Reading};
use super::slots::ModuleElement;
use super::text;
use crate::lint::finding::{Findings, Report};
use crate::lint::{self, Modules, rules};
use crate::{Group, Vendor};

/// The root element of most files.
const ROOT: &str = "EtherCATInfo";

/// Maximum number of devices of a file.
const DEVICES_MAX: usize = 10_000;

/// An ESI file, or a file of modules.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EsiFile {
    /// The devices, in the order of the file.
    pub devices: Vec<DeviceElement>,
    /// The modules, in the order of the file.
    pub modules: Vec<ModuleElement>,
    /// What is wrong with the file.
    pub findings: Findings,
}

/// The contents of a file that an ESI file names, relative to it; none if it is not there.
pub type External<'a> = dyn Fn(&str) -> Option<Vec<u8>> + 'a;

impl EsiFile {
    /// Reads a file. `external` has the contents of further files: dictionaries.
    pub fn read(bytes: &[u8], external: &External<'_>) -> Result<Self, ReadError> {
        let ((devices, modules, more), mut findings) = document::read(bytes, |reading| {
            let (devices, modules, more) = elements(Element::root(reading), external)?;
            lint_all(&devices, &modules, reading);
            Ok((devices, modules, more))
        })?;
        findings.append(more);
        Ok(Self { devices, modules, findings: findings.sorted() })
    }
}

fn elements(
    root: Element<'_>,
    external: &External<'_>,
) -> Result<(Vec<DeviceElement>, Vec<ModuleElement>, Findings), ReadError> {
    let infos: Vec<Element<'_>> = match root.name() {
        "EtherCATInfo" | "EtherCATModule" => vec![root],
        "EtherCATInfoList" => root.all("EtherCATInfo").collect(),
        other => {
            return Err(ReadError::AnotherRoot {
                place: root.place(),
                root: other.to_owned(),
                expected: ROOT,
            });
        }
    };
    let (mut devices, mut modules, mut files) = (Vec::new(), Vec::new(), DictionaryFiles::new(external));
    for info in infos {
        let vendor = Arc::new(vendor(info));
        let descriptions = info.child("Descriptions").unwrap_or(info);
        let of = |list, name| {
            descriptions.child(list).into_iter().flat_map(move |list: Element<'_>| list.all(name))
        };
        let groups: Vec<_> = of("Groups", "Group").map(group).map(Arc::new).collect();
        for element in of("Devices", "Device") {
            if devices.len() == DEVICES_MAX {
                let message = format!("the file has more than {DEVICES_MAX} devices; the others are dropped");
                element.report(rules::TOO_MANY_DEVICES, message);
                break;
            }
            let mut device = DeviceElement::read(element, &vendor, &groups);
            files.complete(&mut device.profiles, element);
            devices.push(device);
        }
        for element in of("Modules", "Module") {
            if let Some(mut module) = ModuleElement::read(element) {
                files.complete(&mut module.profiles, element);
                modules.push(module);
            }
        }
    }
    Ok((devices, modules, files.findings))
}

fn vendor(info: Element<'_>) -> Vendor {
    let vendor = info.child("Vendor");
    let id = vendor.and_then(|vendor| vendor.number_of("Id"));
    if id.is_none() {
        info.report(rules::VENDOR_ID, "the file has no vendor ID; read as 0".into());
    }
    Vendor { id: id.unwrap_or(0), name: vendor.map(|vendor| vendor.localized("Name")).unwrap_or_default() }
}

fn group(element: Element<'_>) -> Group {
    Group { group_type: element.text_of("Type").to_owned(), name: element.localized("Name") }
}

fn lint_all(devices: &[DeviceElement], modules: &[ModuleElement], report: &dyn Report) {
    lint::check_identities(devices, report);
    let known = Modules::of(modules, report);
    for device in devices {
        lint::check_device(device, &known, report);
    }
    let profiles = devices.iter().flat_map(|device| &device.profiles);
    let profiles = profiles.chain(modules.iter().flat_map(|module| &module.profiles));
    // Those of external files have been checked when they were read.
    for dictionary in
        profiles.filter(|profile| profile.dictionary_file.is_none()).filter_map(|p| p.dictionary.as_ref())
    {
        lint::check_dictionary(dictionary, report);
    }
}

/// The dictionaries of external files, each read once.
struct DictionaryFiles<'a> {
    external: &'a External<'a>,
    known: BTreeMap<String, Option<Arc<DictionaryElement>>>,
    findings: Findings,
}

impl<'a> DictionaryFiles<'a> {
    fn new(external: &'a External<'a>) -> Self {
        Self { external, known: BTreeMap::new(), findings: Findings::default() }
    }

    /// Adds their dictionaries to profiles that name an external file.
    fn complete(&mut self, profiles: &mut [ProfileElement], element: Element<'_>) {
        for profile in profiles.iter_mut().filter(|profile| profile.dictionary.is_none()) {
            let Some(name) = profile.dictionary_file.clone() else { continue };
            if !self.known.contains_key(&name) {
                let dictionary = self.read(&name).map_err(|reason| {
                    let name = user_file::shown(&name);
                    element.report(
                        rules::EXTERNAL_FILE,
                        format!("DictionaryFile `{name}` {reason}; read as missing"),
                    );
                });
                self.known.insert(name.clone(), dictionary.ok());
            }
            profile.dictionary = self.known.get(&name).cloned().flatten();
        }
    }

    fn read(&mut self, name: &str) -> Result<Arc<DictionaryElement>, String> {
        let bytes = (self.external)(name).ok_or("is not there")?;
        if bytes.len() > ReadError::LENGTH_BYTES_MAX {
            return Err(ReadError::TooLong { length_bytes: bytes.len() }.to_string());
        }
        let text = text::decode(&bytes).map_err(|error| error.to_string())?;
        let document = reading::parse(&text.text).map_err(|error| error.to_string())?;
        let reading = Reading::new(&document, Some(name.to_owned()));
        let root = Element::root(&reading);
        let element = match root.name() {
            "Dictionary" => Some(root),
            _ => root.child("Dictionary"),
        };
        let dictionary = DictionaryElement::read(element.ok_or("has no element Dictionary")?);
        lint::check_dictionary(&dictionary, &reading);
        self.findings.append(reading.into_findings());
        Ok(Arc::new(dictionary))
    }
}
