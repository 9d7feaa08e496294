//! SDO services in addition to plain reads and writes of an entry: complete access, segments, SDO information.

use ::master::{SdoInformation, SdoTransfer, Service};
use wire::{ObjectIndex, SdoInfoList, SdoInfoRequest, SdoTarget, SubIndex, ValueInfo};

use super::asked_sdo::AskedSdo;
use super::operation::{MailboxChannels, Operation};
use crate::model::{Entry, MasterOrder, WhichUnit};

/// Number of bytes of a segment: those of an SDO over CAN.
const SEGMENT_BYTES: usize = 7;

/// One such service.
pub(super) struct SdoService {
    pub(super) unit: WhichUnit,
    asked: AskedSdo,
    service: Service,
}

impl SdoService {
    /// That of an order; none if the order is another one.
    pub(super) fn of(order: &MasterOrder) -> Option<Self> {
        let complete = |entry: &Entry| SdoTarget::complete(entry.index, entry.sub);
        let question = |request| Service::Information(SdoInformation::new(request));
        let (unit, asked, service) = match order {
            MasterOrder::ReadCompleteSdo { unit, entry } => {
                let service = Service::Sdo(SdoTransfer::upload(complete(entry)));
                (unit, AskedSdo::reading(format!("complete SDO upload {entry}")), service)
            }
            MasterOrder::WriteCompleteSdo { unit, entry, value } => {
                let service = Service::Sdo(SdoTransfer::download(complete(entry), &value.0));
                (unit, AskedSdo::writing(format!("complete SDO download {entry}"), &value.0), service)
            }
            MasterOrder::WriteSdoInSegments { unit, entry, value } => {
                let target = SdoTarget::entry(entry.index, entry.sub);
                let transfer = SdoTransfer::download_in_segments(target, &value.0, SEGMENT_BYTES);
                (
                    unit,
                    AskedSdo::writing(format!("segmented SDO download {entry}"), &value.0),
                    Service::Sdo(transfer),
                )
            }
            MasterOrder::ReadObjectList { unit, list } => (
                unit,
                AskedSdo::reading(format!("object list {list}")),
                question(SdoInfoRequest::List(SdoInfoList::from_bits(*list))),
            ),
            MasterOrder::DescribeObject { unit, object } => {
                let words = format!("description of object {:04X}", object.0);
                (unit, AskedSdo::reading(words), question(SdoInfoRequest::Object(ObjectIndex(object.0))))
            }
            MasterOrder::DescribeEntry { unit, entry } => {
                let Entry { index, sub } = *entry;
                let value_info = ValueInfo::DEFAULT | ValueInfo::MINIMUM | ValueInfo::MAXIMUM;
                let request =
                    SdoInfoRequest::Entry { index: ObjectIndex(index), sub: SubIndex(sub), value_info };
                (unit, AskedSdo::reading(format!("description of entry {entry}")), question(request))
            }
            _ => return None,
        };
        Some(Self { unit: unit.clone(), asked, service })
    }

    pub(super) fn operation(&self, unit: usize, channels: MailboxChannels) -> Operation {
        Operation::sdo(unit, channels, self.asked.clone(), self.service.clone())
    }
}
