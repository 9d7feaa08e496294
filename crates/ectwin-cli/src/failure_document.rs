//! The JSON document of a command whose files are wrong or cannot be read, beside the text on stderr.

use serde::Serialize;

use crate::failure::Failure;
use crate::file_problem::ProblemRow;
use crate::output;

#[derive(Serialize)]
struct Document<'a> {
    problems: Vec<ProblemRow<'a>>,
    /// Whether there are more problems than these.
    more: bool,
}

/// Passes a result on. If a command with `--json` fails, the document of its failure is printed first.
pub(crate) fn or_document<T>(json: bool, result: Result<T, Failure>) -> Result<T, Failure> {
    match (json, &result) {
        (true, Err(Failure::BadFile(problems) | Failure::ProgramWrong(problems))) => {
            print(problems.rows().collect(), problems.are_more())?;
        }
        (true, Err(failure)) => {
            let (message, help) = failure.words();
            print(vec![ProblemRow::without_place(&message, help.as_deref())], false)?;
        }
        (true, Ok(_)) | (false, _) => {}
    }
    result
}

fn print(problems: Vec<ProblemRow<'_>>, more: bool) -> Result<(), Failure> {
    output::print(output::json(&Document { problems, more })?.as_bytes())
}
