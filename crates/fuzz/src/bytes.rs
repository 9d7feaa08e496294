//! Damage to bytes.

use crate::random::Random;

/// Maximum length of an input after damage.
const LONGEST: usize = 1 << 16;

/// Damages bytes in one to four places.
pub(crate) fn damage(bytes: &mut Vec<u8>, random: &mut Random) {
    for _ in 0..random.between(1, 4) {
        damage_once(bytes, random);
    }
    bytes.truncate(LONGEST);
}

fn damage_once(bytes: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(bytes.len());
    let some = random.length(200);
    match random.below(9) {
        0 => bytes.truncate(at),
        1 => {
            let end = (at + some).min(bytes.len());
            bytes.drain(at..end);
        }
        2 => {
            let more = random.bytes(some);
            bytes.splice(at..at, more);
        }
        3 => {
            let again = bytes.get(at..(at + some).min(bytes.len())).unwrap_or_default().to_vec();
            let to = random.below(bytes.len());
            bytes.splice(to..to, again);
        }
        4 => overwrite(bytes, at, &random.word().to_le_bytes()),
        5 => {
            let number = random.number() as u32;
            let number = if random.once_in(2) { number.to_le_bytes() } else { number.to_be_bytes() };
            overwrite(bytes, at & !3, &number);
        }
        6 => {
            let near =
                bytes.get(at).map(|byte| byte.wrapping_add(random.one_of(&[1, 2, 0xFF, 4, 0x80]).to_owned()));
            overwrite(bytes, at, near.as_slice());
        }
        7 => overwrite(bytes, at, &[random.byte()]),
        _ => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= 1 << random.below(8);
            }
        }
    }
}

fn overwrite(bytes: &mut [u8], at: usize, with: &[u8]) {
    bytes.iter_mut().skip(at).zip(with).for_each(|(byte, new)| *byte = *new);
}
