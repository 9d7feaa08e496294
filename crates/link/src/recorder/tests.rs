use std::io::Write;
use std::sync::{Arc, Mutex};

use super::*;

/// A medium that another handle reads.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Medium for Shared {}

fn exchange<'a>(request: &'a [u8], answer: Option<&'a [u8]>) -> Seen<'a> {
    Seen { received: Instant::from_nanos(1), request, answered: Instant::from_nanos(2), answer }
}

#[test]
fn request_and_answer_are_two_records() {
    let shared = Shared::default();
    let mut recorder = Recorder::start(shared.clone(), "file", "memory", &Clock::start()).unwrap();
    recorder.frame(exchange(b"request", Some(b"answered")));
    recorder.frame(exchange(b"destroyed", None));
    assert_eq!(recorder.finish().unwrap(), Recording { written: 3, lost: 0 });
    let capture = shared.0.lock().unwrap();
    for text in [&b"request"[..], b"answered", b"destroyed"] {
        assert!(capture.windows(text.len()).any(|window| window == text));
    }
}

/// A medium that accepts nothing until it is released.
struct Stuck(std::sync::mpsc::Receiver<()>);

impl Write for Stuck {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let _ = self.0.recv();
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Medium for Stuck {}

#[test]
fn what_the_medium_cannot_take_is_counted_and_never_waited_for() {
    let (go, stuck) = std::sync::mpsc::channel();
    let mut recorder = Recorder::start(Stuck(stuck), "file", "memory", &Clock::start()).unwrap();
    let total = 2 * QUEUE_FRAMES as u64;
    for _ in 0..total {
        recorder.frame(exchange(&[0; FRAME_BUFFER_BYTES], None));
    }
    drop(go);
    let recording = recorder.finish().unwrap();
    assert!(recording.lost > 0);
    assert_eq!(recording.written + recording.lost, total);
}

/// A disk with this much room; the rest of a write is refused.
#[derive(Clone, Default)]
struct Disk(Arc<Mutex<(Vec<u8>, usize)>>);

impl Disk {
    fn make_room(&self, bytes: usize) {
        self.0.lock().unwrap().1 += bytes;
    }

    /// Numbers of the frames in the capture, and its comments.
    fn frames(&self) -> (Vec<u64>, usize) {
        let disk = self.0.lock().unwrap();
        let packets = capture::read_packets(&disk.0).unwrap();
        let numbers = packets.iter().map(|packet| u64::from_le_bytes(packet.frame[..8].try_into().unwrap()));
        let comment = b"frames before this one are missing";
        (numbers.collect(), disk.0.windows(comment.len()).filter(|window| window == comment).count())
    }
}

impl Write for Disk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut disk = self.0.lock().unwrap();
        let taken = bytes.len().min(disk.1);
        if taken == 0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        disk.0.extend_from_slice(&bytes[..taken]);
        disk.1 -= taken;
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Medium for Disk {
    fn cut(&mut self, length_bytes: u64) -> io::Result<()> {
        self.0.lock().unwrap().0.truncate(usize::try_from(length_bytes).unwrap());
        Ok(())
    }
}

/// The thread's side, and a disk with this much room.
fn writing(room_bytes: usize) -> (Disk, Writing<Disk>) {
    let disk = Disk::default();
    disk.make_room(room_bytes);
    let writer = PcapngWriter::new(Outlet::new(disk.clone(), "memory", Arc::default()), "memory").unwrap();
    (disk, Writing::new(writer))
}

fn take_frames(writing: &mut Writing<Disk>, numbers: std::ops::Range<u64>) {
    for number in numbers {
        let mut bytes = [0; FRAME_BUFFER_BYTES];
        bytes[..8].copy_from_slice(&number.to_le_bytes());
        let direction = Direction::Inbound;
        let record = Record { at_nanos: number, direction, lost_before: 0, length_bytes: 1000, bytes };
        writing.take(&record).unwrap();
    }
}

#[test]
fn a_full_disk_is_tried_again_and_the_capture_is_whole() {
    // In the middle of a block.
    let (disk, mut writing) = writing(3_333);
    take_frames(&mut writing, 0..500);
    writing.writer.out_mut().push();
    disk.make_room(1 << 30);
    writing.writer.out_mut().push();
    take_frames(&mut writing, 500..600);
    assert_eq!(writing.end().unwrap(), Recording { written: 600, lost: 0 });
    assert_eq!(disk.frames(), ((0..600).collect(), 0));
}

#[test]
fn what_a_full_disk_does_not_take_in_time_is_counted_and_marked() {
    let (disk, mut writing) = writing(3_333);
    take_frames(&mut writing, 0..5_000);
    writing.writer.out_mut().push();
    disk.make_room(1 << 30);
    writing.writer.out_mut().push();
    take_frames(&mut writing, 5_000..5_010);
    let recording = writing.end().unwrap();
    assert!(recording.lost > 3_000, "{recording:?}");
    assert_eq!(recording.written + recording.lost, 5_010);
    let (numbers, comments) = disk.frames();
    assert_eq!((numbers.len() as u64, comments), (recording.written, 1));
    assert_eq!(numbers[numbers.len() - 10..], (5_000..5_010).collect::<Vec<_>>());
}

#[test]
fn a_disk_that_stays_full_ends_the_capture_with_a_whole_frame() {
    for room_bytes in [0, 50, 200, 3_333, 100_000] {
        let (disk, mut writing) = writing(room_bytes);
        take_frames(&mut writing, 0..500);
        assert_eq!(writing.end().unwrap_err().kind(), io::ErrorKind::StorageFull);
        let length_bytes = disk.0.lock().unwrap().0.len();
        assert!(length_bytes <= room_bytes);
        if length_bytes > 0 {
            let (numbers, _) = disk.frames();
            assert_eq!(numbers, (0..numbers.len() as u64).collect::<Vec<_>>());
        }
    }
}

#[test]
fn a_medium_that_accepts_nothing_does_not_hold_up_the_end() {
    let (_nobody_reads, stuck) = std::sync::mpsc::channel();
    let mut recorder = Recorder::start(Stuck(stuck), "pipe", "memory", &Clock::start()).unwrap();
    recorder.patience = Duration::from_millis(1);
    recorder.frame(exchange(b"request", None));
    let lost = recorder.finish().unwrap_err();
    assert_eq!(lost.kind(), io::ErrorKind::TimedOut);
    assert!(lost.to_string().contains("it has accepted nothing for 0.001 s"), "{lost}");
}

#[test]
fn a_medium_that_is_slow_gets_all_frames_at_the_end() {
    let (go, stuck) = std::sync::mpsc::channel();
    let mut recorder = Recorder::start(Stuck(stuck), "pipe", "memory", &Clock::start()).unwrap();
    recorder.frame(exchange(b"request", None));
    drop(go);
    assert_eq!(recorder.finish().unwrap(), Recording { written: 1, lost: 0 });
}

#[test]
fn a_frame_is_written_in_time_even_if_others_follow_without_a_pause() {
    let (disk, mut writing) = writing(1 << 20);
    let start = WallInstant::now();
    let mut written = |number: u64, after: Duration| {
        take_frames(&mut writing, number..number + 1);
        writing.flush_if_due(start + after);
        if disk.0.lock().unwrap().0.is_empty() { Vec::new() } else { disk.frames().0 }
    };
    let half = FLUSH_AFTER / 2;
    for (number, after, on_disk) in [
        (0, Duration::ZERO, 0),
        (1, half, 0),
        (2, 2 * half, 3),
        (3, 3 * half, 3),
        (4, 4 * half, 3),
        (5, 5 * half, 6),
    ] {
        assert_eq!(written(number, after), (0..on_disk).collect::<Vec<_>>(), "frame {number}");
    }
}
