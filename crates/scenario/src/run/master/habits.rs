//! The habits of the scripted master.

use ::master::{
    Addressing, Commands, Exchange, Grouping, Habits, Indexes, LostRead, MailboxConduct, TimeOuts,
};
use time::Duration;

/// Time between two reads of the mailboxes.
pub(super) const LISTEN_PERIOD: Duration = Duration::from_millis(10);

/// The habits of a master with this cycle of process data.
pub(super) fn habits(cycle: Duration, phase: Duration) -> Habits {
    Habits {
        addressing: Addressing::Position,
        // One operation at a time; reads of states fill their frames.
        datagrams_max: usize::MAX,
        indexes: Indexes::FromZero,
        answer_patience: Duration::from_millis(2),
        poll_period: Duration::from_micros(500),
        // The ESI gives a unit at most 9 s, in which it reports why it does not reach the state.
        time_outs: TimeOuts::WholeDialogue { state: Duration::from_secs(10), other: Duration::from_secs(5) },
        listen_period: Some(LISTEN_PERIOD),
        // If a read of the mailbox is lost, it reads again, and requests the message again if there is none.
        mailbox: MailboxConduct { lost_read: LostRead::ReadAgain, ..MailboxConduct::NEW },
        // LRW, or LWR and LRD if one datagram is too short; each unit has a separate working counter.
        exchange: Exchange {
            period: cycle,
            phase,
            commands: Commands::Fitting,
            grouping: Grouping::EachSlave,
            ..Exchange::default()
        },
    }
}
