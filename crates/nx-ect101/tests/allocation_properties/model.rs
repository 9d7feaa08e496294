//! The setting rules again, written from the manual and not from the code (5-3, 7-5-4, 8-3-4).

use crate::configurations::{Address, Settings};

/// The reported data of a finding.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Told {
    pub(crate) event: u32,
    pub(crate) rule: &'static str,
    pub(crate) side: &'static str,
    pub(crate) direction: &'static str,
    pub(crate) data_set: Option<u16>,
}

/// 0 is master to CPU Unit, 1 is CPU Unit to master.
const WAYS: [(usize, &str); 2] = [(0, "m_to_c"), (1, "c_to_m")];

pub(crate) const ENTRY_BYTES: [usize; 3] = [30, 10, 4];
pub(crate) const MAXIMUM: [u8; 3] = [40, 10, 32];

/// Index of the PDO mapping object (5-2).
pub(crate) fn pdo(way: usize, set: usize) -> u16 {
    [0x1601, 0x1A01][way] + set as u16
}

/// Index of the PDO entries (5-2).
pub(crate) fn pdo_entry(way: usize, set: usize) -> u16 {
    [0x7000, 0x6000][way] + set as u16
}

/// Index of the I/O entries (5-2).
pub(crate) fn io_entry(way: usize, set: usize) -> u16 {
    [0x6000, 0x7000][way] + set as u16
}

/// Number of the I/O entry mapping in the attached information (8-3-4).
fn io_mapping(way: usize, set: usize) -> u16 {
    [0x1A01, 0x1601][way] + set as u16
}

/// AL status code of an event (8-5-2).
pub(crate) fn al_status_code(event: u32) -> Option<u16> {
    match event {
        0x3509_0000 | 0x3915_0000 | 0x391F_0000 | 0x392D_0000 | 0x392F_0000 => Some(0x0024),
        0x350A_0000 | 0x3914_0000 | 0x391E_0000 | 0x392C_0000 | 0x392E_0000 => Some(0x0025),
        _ => None,
    }
}

/// All findings, in the order in which the unit checks.
pub(crate) fn findings(settings: &Settings) -> Vec<Told> {
    let mut told = Vec::new();
    mandatory(settings, &mut told);
    sync_manager_order(settings, &mut told);
    entry_type(settings, &mut told);
    entry_order(settings, &mut told);
    total(settings, &mut told);
    let sound = WAYS.map(|(_, direction)| told.iter().all(|finding| finding.direction != direction));
    let mut unequal = Vec::new();
    for (way, direction) in WAYS.into_iter().filter(|&(way, _)| sound[way]) {
        unequal.extend(mismatch(settings, way, direction));
    }
    // 5-3-1 comes before 5-3-5.
    unequal.sort_by_key(|finding| finding.rule != "combination");
    told.extend(unequal);
    told
}

/// 7-5-4: 1A00 must be allocated, maximum entries; 7-5-2: 1,204 bytes. 350A and 3509: index, subindex or size is
/// outside of the range.
fn mandatory(settings: &Settings, told: &mut Vec<Told>) {
    for (way, direction) in WAYS {
        let event = [0x350A_0000, 0x3509_0000][way];
        let finding = |side, data_set| Told { event, rule: "mandatory", side, direction, data_set };
        if way == 1 && !settings.assigned[1].contains(&0x1A00) {
            told.push(finding("assignment", None));
        }
        if settings.assigned[way].iter().any(|index| !may_be_assigned(way, *index) && *index != 0) {
            told.push(finding("assignment", None));
        }
        for set in selected_pdos(settings, way) {
            let entries = &settings.pdo[way][set];
            let outside =
                |entry: &Address| entry.0 == pdo_entry(way, set) && (entry.1 == 0 || entry.1 > MAXIMUM[set]);
            if entries.iter().any(outside) || entries.len() > MAXIMUM[set].into() {
                told.push(finding("pdo_entry", Some(pdo(way, set))));
            }
        }
        let status_bytes: usize = settings.assigned[way].iter().map(|&index| status_bytes(index)).sum();
        let data_bytes = pdo_bytes(settings, way);
        if way == 1 && data_bytes <= 1200 && data_bytes + status_bytes > 1204 {
            told.push(finding("pdo_entry", None));
        }
    }
}

/// 5-3-6.
fn sync_manager_order(settings: &Settings, told: &mut Vec<Told>) {
    for (way, direction) in WAYS {
        let known: Vec<u16> =
            settings.assigned[way].iter().copied().filter(|&index| may_be_assigned(way, index)).collect();
        let mut sorted = known.clone();
        sorted.sort_unstable();
        sorted.dedup();
        if known != sorted {
            let event = [0x392E_0000, 0x392F_0000][way];
            told.push(Told { event, rule: "sm_order", side: "assignment", direction, data_set: None });
        }
    }
}

/// 5-3-3.
fn entry_type(settings: &Settings, told: &mut Vec<Told>) {
    for (way, direction) in WAYS {
        for set in 0..3 {
            let illegal =
                |entry: &Address| entry.0 != io_entry(way, set) || entry.1 == 0 || entry.1 > MAXIMUM[set];
            if settings.io[way][set].iter().any(illegal) {
                let (event, data_set) = ([0x391B_0000, 0x391A_0000][way], Some(io_mapping(way, set)));
                told.push(Told { event, rule: "type", side: "io_entry", direction, data_set });
            }
        }
    }
    for (way, direction) in WAYS {
        for set in selected_pdos(settings, way) {
            if settings.pdo[way][set].iter().any(|entry| entry.0 != pdo_entry(way, set) && *entry != (0, 0)) {
                let (event, data_set) = ([0x391E_0000, 0x391F_0000][way], Some(pdo(way, set)));
                told.push(Told { event, rule: "type", side: "pdo_entry", direction, data_set });
            }
        }
    }
}

/// 5-3-4.
fn entry_order(settings: &Settings, told: &mut Vec<Told>) {
    for (way, direction) in WAYS {
        for set in 0..3 {
            if !in_order(&settings.io[way][set], io_entry(way, set), MAXIMUM[set], false) {
                let (event, data_set) = ([0x3919_0000, 0x3913_0000][way], Some(io_mapping(way, set)));
                told.push(Told { event, rule: "order", side: "io_entry", direction, data_set });
            }
        }
    }
    for (way, direction) in WAYS {
        for set in selected_pdos(settings, way) {
            if !in_order(&settings.pdo[way][set], pdo_entry(way, set), MAXIMUM[set], true) {
                let (event, data_set) = ([0x3914_0000, 0x3915_0000][way], Some(pdo(way, set)));
                told.push(Told { event, rule: "order", side: "pdo_entry", direction, data_set });
            }
        }
    }
}

/// Between two neighbours of the correct type, the number of missing subindexes does not exceed the number of
/// entries of a wrong type between them; there is no empty element before an entry of the correct type.
fn in_order(entries: &[Address], index: u16, maximum: u8, knows_empty: bool) -> bool {
    let right = |entry: &Address| entry.0 == index && (1..=maximum).contains(&entry.1);
    let places: Vec<usize> = (0..entries.len()).filter(|&place| right(&entries[place])).collect();
    let mut from = (None, 0);
    for &place in &places {
        let start = from.0.map_or(0, |before: usize| before + 1);
        let between = &entries[start..place];
        let missing = i32::from(entries[place].1) - from.1 - 1;
        if missing < 0 || missing > between.len() as i32 {
            return false;
        }
        from = (Some(place), i32::from(entries[place].1));
    }
    let last = places.last().copied().unwrap_or(0);
    !(knows_empty && entries[..last].contains(&(0, 0)))
}

/// 5-3-2.
fn total(settings: &Settings, told: &mut Vec<Told>) {
    for (way, direction) in WAYS {
        let bytes: usize = settings.io[way].iter().flatten().map(|entry| any_entry_bytes(entry.0)).sum();
        if bytes > 1200 {
            let event = [0x391D_0000, 0x391C_0000][way];
            told.push(Told { event, rule: "total", side: "io_entry", direction, data_set: None });
        }
    }
    for (way, direction) in WAYS {
        if pdo_bytes(settings, way) > 1200 {
            let event = [0x392C_0000, 0x392D_0000][way];
            told.push(Told { event, rule: "total", side: "pdo_entry", direction, data_set: None });
        }
    }
}

/// 5-3-1 and 5-3-5, in a direction whose other rules are satisfied: one event.
fn mismatch(settings: &Settings, way: usize, direction: &'static str) -> Option<Told> {
    let io = |set: usize| settings.io[way][set].len();
    let pdo_entries = |set: usize| match settings.assigned[way].contains(&pdo(way, set)) {
        true => settings.pdo[way][set].iter().filter(|entry| **entry != (0, 0)).count(),
        false => 0,
    };
    let different: Vec<usize> = (0..3).filter(|&set| io(set) != pdo_entries(set)).collect();
    let one_sided = different.iter().any(|&set| io(set) == 0 || pdo_entries(set) == 0);
    let (rule, side) = if one_sided { ("combination", "assignment") } else { ("matched", "pdo_entry") };
    let event = [0x3917_0000, 0x3916_0000][way];
    let data_set = if let [set] = different[..] { Some(pdo(way, set)) } else { None };
    (!different.is_empty()).then_some(Told { event, rule, side, direction, data_set })
}

fn may_be_assigned(way: usize, index: u16) -> bool {
    [&[0x1601, 0x1602, 0x1603][..], &[0x1A00, 0x1A01, 0x1A02, 0x1A03, 0x1BFE, 0x1BFF]][way].contains(&index)
}

/// Data sets whose PDO is assigned.
fn selected_pdos(settings: &Settings, way: usize) -> impl Iterator<Item = usize> + '_ {
    (0..3).filter(move |&set| settings.assigned[way].contains(&pdo(way, set)))
}

/// 7-5-5.
pub(crate) fn status_bytes(index: u16) -> usize {
    match index {
        0x1A00 => 2,
        0x1BFE | 0x1BFF => 1,
        _ => 0,
    }
}

/// Bytes of the assigned data sets; a data set that is assigned twice is sent twice.
fn pdo_bytes(settings: &Settings, way: usize) -> usize {
    let sets = settings.assigned[way].iter().filter_map(|&index| (0..3).find(|&set| pdo(way, set) == index));
    sets.flat_map(|set| &settings.pdo[way][set]).map(|entry| any_entry_bytes(entry.0)).sum()
}

/// Bytes of an entry of any data set.
pub(crate) fn any_entry_bytes(index: u16) -> usize {
    match index {
        0x6000 | 0x7000 => 30,
        0x6001 | 0x7001 => 10,
        0x6002 | 0x7002 => 4,
        _ => 0,
    }
}
