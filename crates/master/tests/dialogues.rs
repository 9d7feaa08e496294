//! Dialogues without a line: every answer is written by hand, correct or incorrect.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use master::{
    Access, Answer, Dialogue, LostRead, MailboxConduct, MailboxDialogue, Progress, SdoInformation,
    SdoTransfer, Service, ServiceFailure, SyncManagerSettings,
};
use proptest::prelude::*;
use wire::{
    CoeHeader, CoeService, MailboxHeader, MailboxType, ObjectIndex, SdoAbort, SdoInfoHeader, SdoInfoList,
    SdoInfoOpcode, SdoInfoRequest, SdoRequest, SdoResponse, SdoTarget, SubIndex,
};

const MAILBOX_BYTES: u16 = 40;
const OUT: SyncManagerSettings =
    SyncManagerSettings { number: 0, start: 0x1000, length_bytes: MAILBOX_BYTES, control: 0x26, activate: 1 };
const IN: SyncManagerSettings =
    SyncManagerSettings { number: 1, start: 0x1200, length_bytes: MAILBOX_BYTES, control: 0x22, activate: 1 };
const TARGET: SdoTarget = SdoTarget::entry(0x2000, 1);

/// A slave that answers each request with this function, with a mailbox for one message.
struct Slave<F> {
    answer: F,
    mailbox: Option<Vec<u8>>,
    counter: u8,
    /// The counter of the last request.
    asked: u8,
    /// The last message that was read, for a repeat request.
    read: Option<Vec<u8>>,
}

impl<F: FnMut(&[u8]) -> Option<Vec<u8>>> Slave<F> {
    fn new(answer: F) -> Self {
        Self { answer, mailbox: None, counter: 0, asked: 0, read: None }
    }

    /// Puts a CoE message after a mailbox header.
    fn put(&mut self, coe: Vec<u8>) {
        self.counter = self.counter % 7 + 1;
        let header = MailboxHeader {
            length_bytes: coe.len() as u16,
            address: 0,
            channel: 0,
            priority: 0,
            mailbox_type: MailboxType::Coe,
            counter: self.counter,
            reserved: false,
        };
        let mut message = [&header.pack()[..], &coe].concat();
        message.resize(usize::from(MAILBOX_BYTES), 0);
        self.mailbox = Some(message);
    }

    /// A message with the counter of the one before it is the same message.
    fn request(&mut self, mailbox: &[u8]) {
        let header = MailboxHeader::parse(mailbox).expect("a mailbox header");
        if core::mem::replace(&mut self.asked, header.counter) != header.counter {
            let body = &mailbox[MailboxHeader::LENGTH_BYTES..][..usize::from(header.length_bytes)];
            if let Some(reply) = (self.answer)(body) {
                self.put(reply);
            }
        }
    }

    fn access(&mut self, access: Access<'_>) -> (u16, Vec<u8>) {
        match access {
            Access::Write { offset: 0x1000, data } => {
                self.request(data);
                (1, data.to_vec())
            }
            Access::Read { offset: 0x080D, .. } => (1, vec![if self.mailbox.is_some() { 8 } else { 0 }]),
            Access::Read { offset: 0x080E, .. } => (1, vec![1]),
            Access::Write { offset: 0x080E, data } => {
                self.mailbox = self.read.clone();
                (1, data.to_vec())
            }
            Access::Read { offset: 0x1200, length_bytes } => match self.mailbox.take() {
                Some(message) => {
                    self.read = Some(message.clone());
                    (1, message)
                }
                None => (0, vec![0; usize::from(length_bytes)]),
            },
            other => panic!("{other:?}"),
        }
    }
}

/// Executes a service; accesses whose number is in `lost` get no answer.
fn carry_out<F>(
    service: Service,
    slave: &mut Slave<F>,
    conduct: MailboxConduct,
    lost: &[usize],
) -> Option<Result<Vec<u8>, ServiceFailure>>
where
    F: FnMut(&[u8]) -> Option<Vec<u8>>,
{
    let mut dialogue = MailboxDialogue::new(OUT, IN, service);
    dialogue.begin(conduct);
    for number in 0..500 {
        let (working_counter, data) = slave.access(dialogue.access());
        let answer = Answer { working_counter, data: &data };
        if dialogue.answer(Some(answer).filter(|_| !lost.contains(&number))) == Progress::Done {
            return Some(dialogue.into_service().into_result());
        }
    }
    None
}

fn sdo<F>(transfer: SdoTransfer, answer: F) -> Option<Result<Vec<u8>, ServiceFailure>>
where
    F: FnMut(&[u8]) -> Option<Vec<u8>>,
{
    carry_out(Service::Sdo(transfer), &mut Slave::new(answer), MailboxConduct::default(), &[])
}

fn response(response: &SdoResponse<'_>) -> Vec<u8> {
    let mut sdo = vec![0; 64];
    let length = response.pack(&mut sdo).expect("it fits");
    [&CoeHeader::new(response.service()).pack()[..], &sdo[..length]].concat()
}

fn request(coe: &[u8]) -> SdoRequest<'_> {
    let (header, sdo) = CoeHeader::parse(coe).expect("a CoE header");
    assert_eq!(header.service, CoeService::SdoRequest);
    SdoRequest::parse(sdo).expect("well formed")
}

/// A server of one value, whose responses have the error `wrong`.
fn server(
    value: Vec<u8>,
    wrong: impl Fn(SdoResponse<'_>) -> Vec<u8>,
) -> impl FnMut(&[u8]) -> Option<Vec<u8>> {
    let mut sent = 0;
    move |coe| match request(coe) {
        SdoRequest::Upload { target } => {
            sent = value.len().min(10);
            let size_bytes = value.len() as u32;
            Some(wrong(SdoResponse::UploadNormal { target, size_bytes, data: &value[..sent] }))
        }
        SdoRequest::UploadSegment { toggle } => {
            let from = sent;
            sent = value.len().min(sent + 10);
            let last = sent == value.len();
            Some(wrong(SdoResponse::UploadSegment { toggle, last, data: &value[from..sent] }))
        }
        _ => None,
    }
}

fn wrong_reply(code: SdoAbort) -> Option<Result<Vec<u8>, ServiceFailure>> {
    Some(Err(ServiceFailure::WrongReply(code)))
}

#[test]
fn a_value_in_segments_is_put_together() {
    let value: Vec<u8> = (0..57).collect();
    assert_eq!(
        sdo(SdoTransfer::upload(TARGET), server(value.clone(), |right| response(&right))),
        Some(Ok(value))
    );
}

#[test]
fn a_wrong_toggle_ends_the_transfer_and_the_slave_is_told() {
    let mut told = None;
    let mut server = server(vec![7; 40], |right| match right {
        SdoResponse::UploadSegment { toggle, last, data } => {
            response(&SdoResponse::UploadSegment { toggle: !toggle, last, data })
        }
        other => response(&other),
    });
    let result = sdo(SdoTransfer::upload(TARGET), |coe| {
        if let SdoRequest::Abort { index, sub, code } = request(coe) {
            told = Some((index, sub, code));
        }
        server(coe)
    });
    assert_eq!(result, wrong_reply(SdoAbort::TOGGLE_BIT_NOT_CHANGED));
    assert_eq!(told, Some((ObjectIndex(0x2000), SubIndex(1), SdoAbort::TOGGLE_BIT_NOT_CHANGED)));
}

#[test]
fn segments_that_never_end_or_promise_too_much_are_ended() {
    let empty = |right: SdoResponse<'_>| match right {
        SdoResponse::UploadSegment { toggle, .. } => {
            response(&SdoResponse::UploadSegment { toggle, last: false, data: &[] })
        }
        other => response(&other),
    };
    assert_eq!(
        sdo(SdoTransfer::upload(TARGET), server(vec![7; 40], empty)),
        wrong_reply(SdoAbort::LENGTH_TOO_LOW)
    );
    let huge = |right: SdoResponse<'_>| match right {
        SdoResponse::UploadNormal { target, data, .. } => {
            response(&SdoResponse::UploadNormal { target, size_bytes: u32::MAX, data })
        }
        other => response(&other),
    };
    assert_eq!(
        sdo(SdoTransfer::upload(TARGET), server(vec![7; 40], huge)),
        wrong_reply(SdoAbort::OUT_OF_MEMORY)
    );
    let small = |right: SdoResponse<'_>| match right {
        SdoResponse::UploadNormal { target, data, .. } => {
            response(&SdoResponse::UploadNormal { target, size_bytes: 15, data })
        }
        other => response(&other),
    };
    assert_eq!(
        sdo(SdoTransfer::upload(TARGET), server(vec![7; 40], small)),
        wrong_reply(SdoAbort::LENGTH_TOO_HIGH)
    );
}

#[test]
fn responses_about_other_objects_are_passed_over() {
    let other = SdoTarget::entry(0x3000, 1);
    let field = [1, 2, 3, 4];
    let mut asked = 0;
    let mut slave = Slave::new(|coe: &[u8]| {
        asked += 1;
        let SdoRequest::Upload { .. } = request(coe) else { return None };
        Some(response(&SdoResponse::UploadExpedited { target: other, field, length_bytes: 4 }))
    });
    let service = Service::Sdo(SdoTransfer::upload(TARGET));
    assert_eq!(carry_out(service, &mut slave, MailboxConduct::default(), &[]), None, "it still waits");
    assert_eq!(asked, 1, "it asks once");
}

#[test]
fn a_download_in_segments_arrives_whole() {
    let value: Vec<u8> = (0..100).collect();
    let mut arrived = Vec::new();
    let result = sdo(SdoTransfer::download(TARGET, &value), |coe| {
        Some(response(&match request(coe) {
            SdoRequest::DownloadNormal { target, size_bytes, data } => {
                assert_eq!(size_bytes, 100);
                arrived = data.to_vec();
                SdoResponse::Download { target }
            }
            SdoRequest::DownloadSegment { toggle, last, data } => {
                arrived.extend(data);
                assert_eq!(last, arrived.len() == 100);
                SdoResponse::DownloadSegment { toggle }
            }
            other => panic!("{other:?}"),
        }))
    });
    assert_eq!((result, arrived), (Some(Ok(Vec::new())), value));
}

#[test]
fn fragments_have_to_count_down() {
    let fragment = |left: u16, indexes: &[u16]| {
        let header = SdoInfoHeader::new(SdoInfoOpcode::ListResponse, left);
        let indexes = indexes.iter().flat_map(|index| index.to_le_bytes());
        let head = [&CoeHeader::new(CoeService::SdoInformation).pack()[..], &header.pack()].concat();
        head.into_iter().chain(indexes).collect::<Vec<u8>>()
    };
    let list = || Service::Information(SdoInformation::new(SdoInfoRequest::List(SdoInfoList::All)));
    let carry = |fragments: Vec<Vec<u8>>| {
        let mut dialogue = MailboxDialogue::new(OUT, IN, list());
        dialogue.begin(MailboxConduct::default());
        let mut slave = Slave::new(|_: &[u8]| None);
        let mut fragments = fragments.into_iter();
        for _ in 0..100 {
            if slave.mailbox.is_none()
                && let Some(next) = fragments.next()
            {
                slave.put(next);
            }
            let (working_counter, data) = slave.access(dialogue.access());
            if dialogue.answer(Some(Answer { working_counter, data: &data })) == Progress::Done {
                return Some(dialogue.into_service().into_result());
            }
        }
        None
    };
    let good = carry(vec![fragment(2, &[1, 0x1000]), fragment(1, &[0x1001]), fragment(0, &[0x1018])]);
    assert_eq!(good, Some(Ok(vec![0x00, 0x10, 0x01, 0x10, 0x18, 0x10])), "without the type of the list");
    let stuck = carry(vec![fragment(2, &[1, 0x1000]), fragment(2, &[0x1001])]);
    assert_eq!(stuck, wrong_reply(SdoAbort::INVALID_SEQUENCE_NUMBER));
}

/// C089: the repeated message has the counter of the lost one, so that a duplicate is identified.
#[test]
fn a_lost_reply_is_asked_for_again_and_one_that_comes_twice_is_dropped() {
    for lost_read in [LostRead::AskAgain, LostRead::ReadAgain] {
        let conduct = MailboxConduct { lost_read, ..MailboxConduct::default() };
        for lost in 0..30 {
            let value: Vec<u8> = (0..57).collect();
            let mut slave = Slave::new(server(value.clone(), |right| response(&right)));
            let service = Service::Sdo(SdoTransfer::upload(TARGET));
            let result = carry_out(service, &mut slave, conduct, &[lost]);
            assert_eq!(result, Some(Ok(value)), "{lost_read:?}, access {lost}");
        }
    }
}

proptest! {
    #[test]
    fn whatever_lies_in_the_mailbox_does_no_harm(
        messages in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..60), 1..20),
    ) {
        for service in [
            Service::Sdo(SdoTransfer::upload(TARGET)),
            Service::Sdo(SdoTransfer::download(TARGET, &[1; 100])),
            Service::Information(SdoInformation::new(SdoInfoRequest::Object(ObjectIndex(0x1000)))),
            Service::Listen,
        ] {
            let mut dialogue = MailboxDialogue::new(OUT, IN, service);
            dialogue.begin(MailboxConduct::default());
            for message in messages.iter().cycle().take(100) {
                let data = match dialogue.access() {
                    Access::Read { offset: 0x080D, .. } => vec![8],
                    Access::Read { .. } => message.clone(),
                    Access::Write { data, .. } => data.to_vec(),
                };
                if dialogue.answer(Some(Answer { working_counter: 1, data: &data })) == Progress::Done {
                    break;
                }
            }
        }
    }
}
