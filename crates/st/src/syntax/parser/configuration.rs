//! `CONFIGURATION … END_CONFIGURATION`. Its words are words of the language only inside it: outside they are names.

use super::super::ast::{Configuration, Expression, File, ProgramInstance, TaskDeclaration};
use super::super::keyword::Keyword;
use super::super::token::Token;
use super::{Failed, Parsed, Parser};
use crate::problem::Problem;

const END: &str = "END_CONFIGURATION";

impl Parser<'_> {
    /// Whether a configuration begins here.
    pub(super) fn at_configuration(&self) -> bool {
        self.at_word("CONFIGURATION") && self.peek(1) == Token::Name
    }

    fn at_word(&self, word: &str) -> bool {
        self.token() == Token::Name && self.text(self.here()).eq_ignore_ascii_case(word)
    }

    fn accept_word(&mut self, word: &str) -> bool {
        let stands_here = self.at_word(word);
        if stands_here {
            self.advance();
        }
        stands_here
    }

    /// Reads it, and adds it to the file.
    pub(super) fn configuration(&mut self, file: &mut File) {
        let span = self.advance();
        self.advance();
        let mut configuration = Configuration { tasks: Vec::new(), programs: Vec::new(), span };
        let mut resources = 0;
        while !self.accept_word(END) {
            let before = self.place;
            if self.configuration_ends() {
                let line = self.line(span);
                let problem = self.missing(&format!("`{END}` for the CONFIGURATION of line {line}"));
                self.tell(problem);
                break;
            }
            if self.configuration_item(file, &mut configuration, &mut resources).is_err() {
                self.recover();
            }
            if self.place == before {
                self.advance();
            }
        }
        self.accept(Token::Semicolon);
        file.configurations.push(configuration);
    }

    /// Whether something begins or ends here that cannot be in a configuration.
    fn configuration_ends(&self) -> bool {
        match self.token() {
            Token::End => true,
            Token::Keyword(Keyword::Program | Keyword::VarGlobal) => false,
            Token::Keyword(word) => word.ends_body() || word.opens_statement(),
            _ => false,
        }
    }

    fn configuration_item(
        &mut self,
        file: &mut File,
        configuration: &mut Configuration,
        resources: &mut u32,
    ) -> Parsed<()> {
        let here = self.here();
        if self.accept(Token::Semicolon) || self.accept_word("END_RESOURCE") {
            return Ok(());
        }
        if self.at(Keyword::VarGlobal) {
            file.globals.push(self.section(Keyword::VarGlobal));
            return Ok(());
        }
        if self.accept_keyword(Keyword::Program) {
            configuration.programs.push(self.program_instance()?);
            return Ok(());
        }
        if self.accept_word("TASK") {
            configuration.tasks.push(self.task()?);
            return Ok(());
        }
        if self.accept_word("RESOURCE") {
            *resources += 1;
            if *resources > 1 {
                let problem = Problem::new(here, "a second RESOURCE in a CONFIGURATION");
                self.tell(problem.help("a CPU Unit is one RESOURCE: put its tasks into the first"));
            }
            return self.resource();
        }
        if self.skip_variables_of_configurations() {
            return Ok(());
        }
        let problem = self.missing(&format!("TASK, PROGRAM or {END}"));
        self.fail(problem)
    }

    /// `Cpu ON PLC` after RESOURCE.
    fn resource(&mut self) -> Parsed<()> {
        self.name("the name of a RESOURCE")?;
        if !self.accept_word("ON") {
            let problem = self.missing("`ON` and a name after the name of a RESOURCE");
            return self.fail(problem);
        }
        self.name("a name after ON").map(|_| ())
    }

    fn skip_variables_of_configurations(&mut self) -> bool {
        let here = self.here();
        let Some(word) = ["VAR_ACCESS", "VAR_CONFIG"].into_iter().find(|word| self.at_word(word)) else {
            return false;
        };
        self.tell(Problem::new(here, format!("{word} is not supported")));
        while self.token() != Token::End && !self.accept_keyword(Keyword::EndVar) {
            self.advance();
        }
        true
    }

    /// `Fast(INTERVAL := T#1ms, PRIORITY := 1);` after TASK.
    fn task(&mut self) -> Parsed<TaskDeclaration> {
        let name = self.name("the name of a TASK")?;
        let mut task = TaskDeclaration { name, interval: None, priority: None };
        self.expect(Token::OpenParenthesis, "`(` after the name of a TASK")?;
        loop {
            self.task_property(&mut task)?;
            if !self.accept(Token::Comma) {
                break;
            }
        }
        self.expect(Token::CloseParenthesis, "`,` or `)` after a property of a TASK")?;
        self.semicolon("a TASK")?;
        Ok(task)
    }

    fn task_property(&mut self, task: &mut TaskDeclaration) -> Parsed<()> {
        let name = self.name("INTERVAL or PRIORITY")?;
        self.expect(Token::Assign, &format!("`:=` after {}", name.text))?;
        let value = self.expression()?;
        match task.property(&name.text) {
            Some(property @ None) => {
                *property = Some(value);
                Ok(())
            }
            Some(Some(_)) => self.fail(Problem::new(name.span, format!("{} is given twice", name.text))),
            None => {
                let problem = Problem::new(name.span, format!("a TASK has no `{}`", name.text));
                self.fail(problem.help("a task is periodic: it has INTERVAL and PRIORITY"))
            }
        }
    }

    /// `Lamp1 WITH Fast : Lamp;` after PROGRAM.
    fn program_instance(&mut self) -> Parsed<ProgramInstance> {
        while self.accept_keyword(Keyword::Retain) || self.accept_keyword(Keyword::NonRetain) {}
        let name = self.name("the name of a program")?;
        let task = if self.accept_word("WITH") { Some(self.name("the name of a TASK")?) } else { None };
        self.expect(Token::Colon, "`:` and the name of a PROGRAM")?;
        let program = self.name("the name of a PROGRAM")?;
        self.refuse_connections()?;
        self.semicolon("a program of a CONFIGURATION")?;
        Ok(ProgramInstance { name, task, program })
    }

    fn refuse_connections(&mut self) -> Parsed<()> {
        if self.token() != Token::OpenParenthesis {
            return Ok(());
        }
        let problem = Problem::new(self.here(), "a program of a CONFIGURATION takes no inputs and outputs");
        self.tell(problem.help("use VAR_GLOBAL"));
        Err(Failed)
    }
}

impl TaskDeclaration {
    fn property(&mut self, name: &str) -> Option<&mut Option<Expression>> {
        let properties = [("INTERVAL", &mut self.interval), ("PRIORITY", &mut self.priority)];
        properties.into_iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, property)| property)
    }
}
