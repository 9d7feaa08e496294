//! Slots and the modules for them (ETG.5001).

use super::element::Element;
use super::mailbox::MailboxElement;
use super::pdo::PdoElement;
use super::place::Place;
use super::profile::ProfileElement;

/// An element `Slots`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SlotsElement {
    /// Its place.
    pub place: Place,
    /// Maximum number of slots, if indicated.
    pub max_count: Option<u16>,
    /// What is added to the index of a PDO for each further slot; none if it is left out.
    pub pdo_increment: Option<u16>,
    /// What is added to the index of an object for each further slot; none if it is left out.
    pub index_increment: Option<u16>,
    /// The transition at which the master writes the list of modules to 0xF030, if it writes it.
    pub download_at: Option<String>,
    /// The slots.
    pub slots: Vec<SlotElement>,
}

/// An element `Slot`: one slot, or several of a kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SlotElement {
    /// Its place.
    pub place: Place,
    /// Its name.
    pub name: String,
    /// Minimum number of slots of this kind that have a module.
    pub min_instances: u16,
    /// Number of slots of this kind.
    pub max_instances: u16,
    /// The idents of the modules that may be plugged, and whether each is the default.
    pub idents: Vec<(u32, bool)>,
    /// The classes of the modules that may be plugged.
    pub classes: Vec<String>,
}

/// An element `Module`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModuleElement {
    /// Its place.
    pub place: Place,
    /// The number that identifies it, in 0xF030 and 0xF050.
    pub ident: u32,
    /// Its class, to which slots refer.
    pub class: String,
    /// Its order code, the text of `Type`.
    pub order_code: String,
    /// Its name.
    pub name: String,
    /// PDOs from master to slave.
    pub rx_pdos: Vec<PdoElement>,
    /// PDOs from slave to master.
    pub tx_pdos: Vec<PdoElement>,
    /// Its part of the mailbox, such as init commands.
    pub mailbox: Option<MailboxElement>,
    /// Its part of the dictionary.
    pub profiles: Vec<ProfileElement>,
}

impl SlotsElement {
    pub(super) fn read(element: Element<'_>) -> Self {
        let groups = element.all("SlotGroup").flat_map(|group| group.all("Slot").collect::<Vec<_>>());
        let downloaded = element.flag("DownloadModuleIdentList");
        let transition = element.attribute("DownloadModuleListTransition").map_or("PS", |value| value.text);
        Self {
            place: element.place(),
            max_count: element.number("MaxSlotCount"),
            pdo_increment: element.number("SlotPdoIncrement"),
            index_increment: element.number("SlotIndexIncrement"),
            download_at: downloaded.then(|| transition.to_owned()),
            slots: element.all("Slot").chain(groups).map(SlotElement::read).collect(),
        }
    }

    /// The number of slots of all kinds.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.slots.iter().map(|slot| u32::from(slot.max_instances)).sum()
    }
}

impl SlotElement {
    fn read(element: Element<'_>) -> Self {
        let ident = |ident: Element<'_>| Some((ident.value().number()?, ident.flag("Default")));
        Self {
            place: element.place(),
            name: element.localized("Name"),
            min_instances: element.number("MinInstances").unwrap_or(0),
            max_instances: element.number("MaxInstances").unwrap_or(1),
            idents: element.all("ModuleIdent").filter_map(ident).collect(),
            classes: element.all("ModuleClass").map(|class| class_name(class).to_owned()).collect(),
        }
    }
}

/// The class is an element `Class` in files of the newer schema, and a text in older ones.
fn class_name(element: Element<'_>) -> &str {
    element.child("Class").map_or_else(|| element.text(), Element::text)
}

impl ModuleElement {
    pub(super) fn read(element: Element<'_>) -> Option<Self> {
        let kind = element.child("Type")?;
        Some(Self {
            place: element.place(),
            ident: kind.number("ModuleIdent")?,
            class: kind.attribute("ModuleClass").map(|class| class.text).unwrap_or_default().to_owned(),
            order_code: kind.text().to_owned(),
            name: element.localized("Name"),
            rx_pdos: element.all("RxPdo").filter_map(PdoElement::read).collect(),
            tx_pdos: element.all("TxPdo").filter_map(PdoElement::read).collect(),
            mailbox: element.child("Mailbox").map(MailboxElement::read),
            profiles: element.all("Profile").map(ProfileElement::read).collect(),
        })
    }
}

impl ModuleElement {
    /// The PDOs of both directions.
    pub fn pdos(&self) -> impl Iterator<Item = &PdoElement> {
        self.rx_pdos.iter().chain(&self.tx_pdos)
    }
}
