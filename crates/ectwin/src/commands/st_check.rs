//! `ectwin st check FILE.st`.

use ectwin::unit_file::UnitFile;
use ectwin::{DeviceVariables, StructuredText, st};
use serde::Serialize;

use crate::cli::StCheckArgs;
use crate::failure::Failure;
use crate::{output, unit_files};

/// The unit whose device variables a program sees when none is named: the factory setting.
const FACTORY: &str = "model = \"nx-ect101\"";

#[derive(Serialize)]
struct Document<'a> {
    problems: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Row<'a> {
    line: usize,
    column: usize,
    message: &'a str,
    help: Option<&'a str>,
}

/// Checks a program and tells what is wrong with it.
pub(crate) fn run(args: &StCheckArgs) -> Result<(), Failure> {
    let variables = DeviceVariables::of_unit_file(&unit_file(args)?);
    let unreadable = |source| Failure::ProgramUnreadable { path: args.program.clone(), source };
    let source = std::fs::read_to_string(&args.program).map_err(unreadable)?;
    let checked = StructuredText::compile(&source, &variables);
    if args.json {
        let problems = checked.as_ref().err().map(rows).unwrap_or_default();
        output::print(output::json(&Document { problems })?.as_bytes())?;
    }
    match checked {
        Ok(_) if args.json => Ok(()),
        Ok(_) => output::print_line(format_args!("{}: no problems", args.program.display())),
        Err(_) if args.json => Err(Failure::ProgramWrong(Vec::new())),
        Err(problems) => Err(Failure::ProgramWrong(unit_files::of_program(&args.program, &problems))),
    }
}

fn unit_file(args: &StCheckArgs) -> Result<UnitFile, Failure> {
    match &args.unit {
        Some(path) => unit_files::parse(path).map(|(file, _)| file),
        // The one key that a unit file needs.
        None => Ok(UnitFile::parse(FACTORY).unwrap_or_else(|_| unreachable!("the factory setting is right"))),
    }
}

fn rows(problems: &st::Problems) -> Vec<Row<'_>> {
    let row = |problem: &'_ st::Problem| problem.span.line_and_column(problems.source());
    let rows = problems.list().iter().map(|problem| {
        let (line, column) = row(problem);
        Row { line, column, message: &problem.message, help: problem.help.as_deref() }
    });
    rows.collect()
}
