//! `ectwin st check FILE.st`.

use ectwin::st::{Place, Problems};
use ectwin::user_files;
use ectwin::{StructuredText, UnitFile};
use serde::Serialize;

use crate::cli::StCheckArgs;
use crate::failure::Failure;
use crate::failure_document::or_document;
use crate::file_problem::FileProblems;
use crate::{output, unit_files};

#[derive(Serialize)]
struct Document<'a> {
    problems: Vec<Row<'a>>,
    /// Whether there are more problems than these.
    more: bool,
}

#[derive(Serialize)]
struct Row<'a> {
    file: &'a str,
    line: usize,
    column: usize,
    message: &'a str,
    help: Option<&'a str>,
}

/// Checks a program and reports its problems.
pub(crate) fn run(args: &StCheckArgs) -> Result<(), Failure> {
    let variables = or_document(args.json, unit_file(args))?.variables().clone();
    let unreadable = |(path, source)| Failure::Unreadable { path, source };
    let sources = user_files::program_sources(&args.programs).map_err(unreadable);
    let sources = or_document(args.json, sources)?;
    let judged = StructuredText::judge(sources, &variables);
    if args.json {
        let problems = judged.as_ref().err();
        let more = problems.is_some_and(Problems::are_cut);
        let problems = problems.map(rows).unwrap_or_default();
        output::print(output::json(&Document { problems, more })?.as_bytes())?;
    }
    match judged {
        Ok(()) if args.json => Ok(()),
        Ok(()) => {
            let names: Vec<_> = args.programs.iter().map(|path| output::shown(path)).collect();
            output::print_line(format_args!("{}: no problems", names.join(", ")))
        }
        Err(_) if args.json => Err(Failure::ProgramWrong(FileProblems::default())),
        Err(problems) => Err(Failure::ProgramWrong(FileProblems::of_program(&problems))),
    }
}

fn unit_file(args: &StCheckArgs) -> Result<UnitFile, Failure> {
    match &args.unit {
        Some(path) => unit_files::parse(path).map(|(file, _)| file),
        None => Ok(UnitFile::factory()),
    }
}

fn rows(problems: &Problems) -> Vec<Row<'_>> {
    let rows = problems.list().iter().map(|problem| {
        let Place { file, line, column, .. } = problems.place(problem);
        let file = file.unwrap_or_default();
        Row { file, line, column, message: &problem.message, help: problem.help.as_deref() }
    });
    rows.collect()
}
