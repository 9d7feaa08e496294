//! A line of a trace: `10ms: restart, in := TRUE -> q = FALSE, et = T#0s | used 5`.

/// A scan: its time, the values set before it, and the expectations after it.
pub(crate) struct Scan {
    /// The line, for messages.
    pub(crate) line: String,
    pub(crate) time_ns: u64,
    pub(crate) actions: Vec<Action>,
    pub(crate) expectations: Vec<Expectation>,
}

pub(crate) enum Action {
    /// The program restarts.
    Restart,
    /// A variable gets a value.
    Set(String, String),
}

pub(crate) enum Expectation {
    /// A variable has a value.
    Value(String, String),
    /// The scan ends early, here for this reason: `division by zero at 5:9`.
    Fault(String),
    /// This number of statements was used.
    Used(u64),
    /// SetAlarm, SetInfo and ResetAlarm report this: `alarm 5 1 2`, `reset 5`.
    Told(String),
}

impl Scan {
    pub(crate) fn read(line: &str) -> Result<Self, String> {
        let fault = || format!("`{line}` is no line of a trace");
        let (time, rest) = line.split_once(':').ok_or_else(fault)?;
        let (actions, expectations) = rest.split_once("->").ok_or_else(fault)?;
        let actions = listed(actions).map(|action| read_action(&action)).collect::<Result<Vec<_>, _>>()?;
        let mut all = Vec::new();
        for part in expectations.split(" | ").map(str::trim) {
            all.extend(expectations_of(part)?);
        }
        if all.is_empty() {
            return Err(format!("`{line}` expects nothing"));
        }
        let time_ns = time_ns(time).ok_or_else(fault)?;
        Ok(Self { line: line.to_owned(), time_ns, actions, expectations: all })
    }
}

fn time_ns(text: &str) -> Option<u64> {
    let digits = text.find(|character: char| !character.is_ascii_digit())?;
    let (number, unit) = text.split_at(digits);
    let factor = match unit {
        "s" => 1_000_000_000,
        "ms" => 1_000_000,
        "us" => 1_000,
        "ns" => 1,
        _ => return None,
    };
    number.parse::<u64>().ok()?.checked_mul(factor)
}

fn read_action(text: &str) -> Result<Action, String> {
    if text == "restart" {
        return Ok(Action::Restart);
    }
    let (path, value) = text.split_once(" := ").ok_or_else(|| format!("`{text}` sets nothing"))?;
    Ok(Action::Set(path.to_owned(), value.to_owned()))
}

fn expectations_of(part: &str) -> Result<Vec<Expectation>, String> {
    if let Some(fault) = part.strip_prefix("fault: ") {
        return Ok(vec![Expectation::Fault(fault.to_owned())]);
    }
    if let Some(place) = part.strip_prefix("overrun at ") {
        return Ok(vec![Expectation::Fault(format!(
            "the statement budget of the task is used up at {place}"
        ))]);
    }
    if let Some(used) = part.strip_prefix("used ") {
        let used = used.parse().map_err(|_| format!("`{part}`"))?;
        return Ok(vec![Expectation::Used(used)]);
    }
    if part.starts_with("alarm ") || part.starts_with("reset ") {
        return Ok(vec![Expectation::Told(part.to_owned())]);
    }
    let value = |text: String| match text.split_once(" = ") {
        Some((path, value)) => Ok(Expectation::Value(path.to_owned(), value.to_owned())),
        None => Err(format!("`{text}` is no expectation")),
    };
    listed(part).map(value).collect()
}

/// The parts between commas, except commas inside brackets, parentheses and texts.
fn listed(text: &str) -> impl Iterator<Item = String> {
    let (mut parts, mut depth, mut quoted) = (vec![String::new()], 0_i32, false);
    for character in text.chars() {
        match character {
            '\'' => quoted = !quoted,
            '[' | '(' if !quoted => depth += 1,
            ']' | ')' if !quoted => depth -= 1,
            _ => {}
        }
        match parts.last_mut() {
            Some(last) if character != ',' || quoted || depth > 0 => last.push(character),
            _ => parts.push(String::new()),
        }
    }
    parts.into_iter().map(|part| part.trim().to_owned()).filter(|part| !part.is_empty())
}
