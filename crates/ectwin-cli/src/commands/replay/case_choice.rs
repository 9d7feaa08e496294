//! `--case`: the cases with these values of their parameters, in any order and with any blanks.

/// Which of these names of cases are meant, by their places: the one that is written like this, or those with the same
/// values.
pub(super) fn chosen(names: &[Option<&str>], wanted: &str) -> Vec<usize> {
    let all = |is_it: &dyn Fn(&str) -> bool| {
        let places = (0..).zip(names).filter(|(_, name)| name.is_some_and(is_it));
        places.map(|(place, _)| place).collect::<Vec<usize>>()
    };
    let exact = all(&|name| name == wanted);
    if !exact.is_empty() {
        return exact;
    }
    let wanted = values(wanted);
    all(&|name| values(name) == wanted)
}

/// `state = OP, loss = 1` as its values in the order of their names.
fn values(text: &str) -> Vec<(String, String)> {
    let mut values: Vec<(String, String)> = Vec::new();
    for part in text.split(',') {
        match (part.split_once('='), values.last_mut()) {
            (Some((name, value)), _) => values.push((name.trim().to_owned(), value.trim().to_owned())),
            // A comma in a value.
            (None, Some((_, value))) => value.push_str(&format!(", {}", part.trim())),
            (None, None) => values.push((part.trim().to_owned(), String::new())),
        }
    }
    values.sort();
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_and_blanks_do_not_matter_and_the_same_writing_is_first() {
        let names = [Some("loss = 1, state = OP"), None, Some("loss = 2, state = OP"), Some("text = a, b")];
        let chosen = |wanted: &str| chosen(&names, wanted);
        assert_eq!(chosen("loss = 2, state = OP"), [2]);
        assert_eq!(chosen("state=OP,loss=1"), [0]);
        assert_eq!(chosen("  state =OP ,  loss= 2"), [2]);
        assert_eq!(chosen("text=a,b"), [3]);
        for none in ["loss = 1", "loss = 3, state = OP", "", "state = OP", "loss = 1, state = OP, loss = 1"] {
            assert!(chosen(none).is_empty(), "{none}");
        }
        assert_eq!(super::chosen(&[Some("a = 1,2"), Some("a = 1, 2")], "a = 1, 2"), [1]);
    }
}
