//! The VLAN tag of a frame: the kernel removes it before a packet socket gets the frame, and reports it separately.

use uapi::c;

/// Room for the control messages of one frame.
pub(super) const CONTROL_BYTES: usize = uapi::cmsg_space(size_of::<c::tpacket_auxdata>());

const TAG_BYTES: usize = 4;
/// Position of a tag in a frame: after the addresses.
const TAG_AT: usize = 12;
/// The tag protocol for kernels that do not report it.
const CUSTOMER_TAG: u16 = 0x8100;

/// The tag in the control messages of a frame, as it was on the cable.
pub(super) fn tag_in(mut control: &[u8]) -> Option<[u8; TAG_BYTES]> {
    while let Ok((_, header, data)) = uapi::cmsg_read(&mut control) {
        if (header.cmsg_level, header.cmsg_type) == (c::SOL_PACKET, c::PACKET_AUXDATA) {
            return tag_of(data);
        }
    }
    None
}

/// Reads `tpacket_auxdata`: the status is its first field, tag control information and tag protocol the last two.
fn tag_of(auxiliary: &[u8]) -> Option<[u8; TAG_BYTES]> {
    let status = u32::from_ne_bytes(*auxiliary.first_chunk()?);
    let (rest, protocol) = auxiliary.split_last_chunk()?;
    let (_, control) = rest.split_last_chunk()?;
    if status & c::TP_STATUS_VLAN_VALID == 0 {
        return None;
    }
    let protocol = match status & c::TP_STATUS_VLAN_TPID_VALID {
        0 => CUSTOMER_TAG,
        _ => u16::from_ne_bytes(*protocol),
    };
    let ([p0, p1], [c0, c1]) = (protocol.to_be_bytes(), u16::from_ne_bytes(*control).to_be_bytes());
    Some([p0, p1, c0, c1])
}

/// Puts the tag back into a frame of `length_bytes` at the start of `buffer`. Returns the new length; bytes
/// that do not fit are cut off.
pub(super) fn insert(tag: [u8; TAG_BYTES], buffer: &mut [u8], length_bytes: usize) -> usize {
    let tagged_bytes = (length_bytes + TAG_BYTES).min(buffer.len());
    let Some(behind_addresses) = buffer.get_mut(TAG_AT..tagged_bytes) else { return length_bytes };
    let Some(moved_bytes) = behind_addresses.len().checked_sub(TAG_BYTES) else { return length_bytes };
    behind_addresses.copy_within(..moved_bytes, TAG_BYTES);
    for (byte, of_tag) in behind_addresses.iter_mut().zip(tag) {
        *byte = of_tag;
    }
    tagged_bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    const ADDRESSES: [u8; 12] = [7; 12];
    const TAG: [u8; 4] = [0x81, 0x00, 0xA0, 0x64];

    #[test]
    fn a_tag_goes_behind_the_addresses() {
        let mut buffer = [0; 64];
        buffer[..12].copy_from_slice(&ADDRESSES);
        buffer[12..16].copy_from_slice(&[0x88, 0xA4, 1, 2]);
        assert_eq!(insert(TAG, &mut buffer, 16), 20);
        assert_eq!(buffer[..12], ADDRESSES);
        assert_eq!(buffer[12..20], [0x81, 0x00, 0xA0, 0x64, 0x88, 0xA4, 1, 2]);
    }

    #[test]
    fn what_has_no_room_is_cut_off_and_what_is_no_frame_stays() {
        let mut full = [9; 18];
        assert_eq!(insert(TAG, &mut full, 18), 18);
        assert_eq!(full[12..], [0x81, 0x00, 0xA0, 0x64, 9, 9]);
        for length_bytes in 0..8 {
            let mut short = [9; 8];
            assert_eq!(insert(TAG, &mut short, length_bytes), length_bytes);
            assert_eq!(short, [9; 8]);
        }
    }

    #[test]
    fn control_messages_of_any_bytes_report_a_tag_or_none() {
        proptest::proptest!(|(bytes in proptest::collection::vec(proptest::num::u8::ANY, 0..128))| {
            let _any = tag_in(&bytes);
            let _any = tag_of(&bytes);
        });
    }

    #[test]
    fn the_tag_is_reported_only_where_the_status_says_so() {
        let auxiliary = |status: u32| {
            let mut bytes = status.to_ne_bytes().to_vec();
            bytes.extend([0; 12]);
            bytes.extend(0xA064_u16.to_ne_bytes());
            bytes.extend(0x88A8_u16.to_ne_bytes());
            bytes
        };
        assert_eq!(tag_of(&auxiliary(1)), None);
        assert_eq!(tag_of(&auxiliary(0x10)), Some(TAG));
        assert_eq!(tag_of(&auxiliary(0x50)), Some([0x88, 0xA8, 0xA0, 0x64]));
    }
}
