//! The features of a file that are visible in its first bytes.

use std::borrow::Cow;

/// Number of bytes that are examined.
const HEAD_BYTES: usize = 16 * 1024;

/// The part of a file that identifies its kind.
pub(crate) struct Sample<'f> {
    pub(crate) bytes: &'f [u8],
    /// The ending of its name in small letters; empty if it has none.
    pub(crate) ending: String,
    /// Its first bytes as text, whatever they are.
    pub(crate) head: Cow<'f, str>,
}

impl<'f> Sample<'f> {
    pub(crate) fn of(bytes: &'f [u8], name: &str) -> Self {
        let head = String::from_utf8_lossy(bytes.get(..HEAD_BYTES).unwrap_or(bytes));
        let file = name.rsplit(['/', '\\']).next().unwrap_or_default();
        let ending = file.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase());
        Self { bytes, ending: ending.unwrap_or_default(), head }
    }

    /// The first tag of an XML document, from its name on; none if this is not such a document.
    pub(crate) fn root(&self) -> Option<&str> {
        let mut rest = self.start();
        loop {
            rest = rest.trim_start().strip_prefix('<')?;
            let end = match rest.as_bytes().first()? {
                b'?' => "?>",
                b'!' if rest.starts_with("!--") => "-->",
                b'!' => ">",
                first if first.is_ascii_alphabetic() => return Some(rest.split('>').next().unwrap_or(rest)),
                _ => return None,
            };
            rest = rest.split_once(end)?.1;
        }
    }

    /// Whether it is an XML document whose root element has this name, in whatever name space.
    pub(crate) fn is_xml_of(&self, element: &str) -> bool {
        let name = self.root().and_then(|root| root.split([' ', '\t', '\r', '\n', '/']).next());
        name.is_some_and(|name| name.rsplit(':').next() == Some(element))
    }

    /// Its text from the first character that is not blank.
    pub(crate) fn start(&self) -> &str {
        self.head.trim_start_matches('\u{feff}').trim_start()
    }

    /// Whether a line of it gives this key a value at the top of a TOML file.
    pub(crate) fn has_top_key(&self, key: &str) -> bool {
        let is_top = |line: &&str| !line.trim_start().starts_with('[');
        self.start().lines().take_while(is_top).any(|line| is_key(line, key))
    }

    /// Whether a line of it begins this list of a TOML file.
    pub(crate) fn has_list(&self, key: &str) -> bool {
        let table = format!("[[{key}]]");
        self.start().lines().any(|line| line.starts_with(&table) || is_key(line, key))
    }
}

/// Whether a line is `key = …`.
fn is_key(line: &str, key: &str) -> bool {
    let value = line.strip_prefix(key).map(str::trim_start);
    value.is_some_and(|value| value.starts_with('=') && !value.starts_with("=="))
}
