use ectwin::{AlState, AlStatusCode, Duration, FrameFate, Twin};

const APRD: u8 = 1;
const APWR: u8 = 2;

/// One datagram to the first unit. Returns its data as it came back, and its working counter.
fn datagram<const N: usize>(twin: &mut Twin, command: u8, offset: u16, data: [u8; N]) -> ([u8; N], u16) {
    let mut frame = vec![0xFF; 12]; // destination and source address
    frame.extend([0x88, 0xA4]); // EtherType
    frame.extend((0x1000 | (12 + N) as u16).to_le_bytes()); // length, type 1
    frame.extend([command, 0, 0, 0]); // index 0, position 0
    frame.extend(offset.to_le_bytes());
    frame.extend((N as u16).to_le_bytes());
    frame.extend([0, 0]); // IRQ field
    frame.extend(data);
    frame.extend([0, 0]); // working counter
    assert_eq!(twin.frame(&mut frame), FrameFate::Returned);
    let (data, counter) = frame[26..].split_first_chunk().unwrap();
    (*data, u16::from_le_bytes([counter[0], counter[1]]))
}

#[test]
fn init_to_pre_op_and_a_refusal() {
    let mut twin = Twin::from_toml("model = \"nx-ect101\"").unwrap();

    // SyncManagers 0 and 1 as the ESI says, then AL control: PRE-OP.
    datagram(&mut twin, APWR, 0x0800, [0x00, 0x10, 0x90, 0x01, 0x26, 0, 1, 0]);
    datagram(&mut twin, APWR, 0x0808, [0x00, 0x12, 0x90, 0x01, 0x22, 0, 1, 0]);
    assert_eq!(datagram(&mut twin, APWR, 0x0120, [0x02, 0]).1, 1);
    assert_eq!(datagram(&mut twin, APRD, 0x0130, [0, 0]), ([0x02, 0], 1));

    // OP cannot be reached from PRE-OP: the master reads PRE-OP with error, and the reason.
    datagram(&mut twin, APWR, 0x0120, [0x08, 0]);
    assert_eq!(datagram(&mut twin, APRD, 0x0130, [0, 0]).0, [0x12, 0]);
    assert_eq!(datagram(&mut twin, APRD, 0x0134, [0, 0]).0, [0x11, 0]);

    // The internal side of the unit, which is not visible to a master.
    assert_eq!(twin.unit(0).state(), AlState::PreOp);
    assert_eq!(twin.unit(0).al_status_code(), AlStatusCode::INVALID_REQUESTED_STATE_CHANGE);

    // Advance the time by one hour.
    let before = twin.now();
    twin.run_for(Duration::from_secs(3600));
    assert_eq!(twin.now(), before + Duration::from_secs(3600));
}
