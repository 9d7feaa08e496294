use ectwin::master::{Failure, Master, ServiceFailure, StateRequest, Wait};
use ectwin::wire::{SdoAbort, SdoTarget};
use ectwin::{AlState, AlStatusCode, Duration, Twin};

#[test]
fn a_master_takes_a_unit_to_op() {
    let twin = Twin::from_toml("model = \"nx-ect101\"").unwrap();
    let mut bench = twin.connect(Master::default());

    // Find the units: the master gives them station addresses and reads their SIIs.
    assert_eq!(bench.search(), Ok(1));
    bench.take_to(0, AlState::PreOp).unwrap();

    // SDOs: the product code can be read, but not written.
    let product_code = SdoTarget::entry(0x1018, 2);
    assert_eq!(bench.upload(0, product_code), Ok(vec![0x7C, 0x01, 0, 0]));
    let refusal = Failure::Mailbox(ServiceFailure::Abort(SdoAbort::READ_ONLY));
    assert_eq!(bench.download(0, product_code, &[0; 4]), Err(refusal));

    // OP cannot be reached from PRE-OP: the master reads PRE-OP with error, and the reason.
    let refused = bench.request_state(0, StateRequest::new(AlState::Op, Wait::SafeOpOp));
    let Err(Failure::Refused(report)) = refused else { panic!("{refused:?}") };
    assert_eq!((report.status.state, report.status.error), (AlState::PreOp, true));
    assert_eq!(report.code, AlStatusCode::INVALID_REQUESTED_STATE_CHANGE);

    // The sequence of a real master: it acknowledges the error, sets SyncManagers and FMMUs, and sends process data.
    bench.take_to(0, AlState::Op).unwrap();
    assert_eq!(bench.line.unit(0).state(), AlState::Op);

    // Values in both directions: two bytes of status, then the first UINT array.
    bench.master.outputs_mut(0)[..2].copy_from_slice(&[0x78, 0x56]);
    bench.line.unit(0).io_mut().set_uints(1, [0x1234; 15]);
    bench.run_for(Duration::from_millis(10));
    assert_eq!(bench.line.unit(0).io().uints(1).unwrap()[0], 0x5678);
    assert_eq!(bench.master.inputs(0)[2..4], [0x34, 0x12]);

    // The master stops. The unit notices it after its watchdog time, 100 ms.
    bench.master.stop_exchange();
    bench.run_for(Duration::from_millis(200));
    let report = bench.al_report(0).unwrap();
    assert_eq!((report.status.state, report.code), (AlState::SafeOp, AlStatusCode::SYNC_MANAGER_WATCHDOG));
}
