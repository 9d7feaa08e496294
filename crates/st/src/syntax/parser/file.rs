//! Files: program organization units, and the parts outside them.

use super::super::ast::{File, Name, Pou, PouKind, TypeName};
use super::super::keyword::Keyword;
use super::super::token::Token;
use super::Parser;
use super::statements::Place;
use crate::problem::{Problem, Span};

/// The word that begins a declaration of the standard that the language does not support, and the word that ends it.
const UNSUPPORTED: [(&str, &str); 6] = [
    ("NAMESPACE", "END_NAMESPACE"),
    ("CLASS", "END_CLASS"),
    ("INTERFACE", "END_INTERFACE"),
    ("METHOD", "END_METHOD"),
    ("ACTION", "END_ACTION"),
    ("VAR_ACCESS", "END_VAR"),
];

impl Parser<'_> {
    /// Reads all of it.
    pub(in super::super) fn file(mut self) -> (File, Vec<Problem>) {
        let mut file = File::default();
        let mut unnamed = None;
        while self.token() != Token::End {
            let before = self.place;
            self.item(&mut file, &mut unnamed);
            if self.place == before {
                self.advance();
            }
        }
        file.units.extend(unnamed);
        self.problems.sort_by_key(|problem| problem.span.start);
        (file, self.problems)
    }

    fn item(&mut self, file: &mut File, unnamed: &mut Option<Pou>) {
        self.mend_statement();
        let here = self.here();
        match self.keyword() {
            Some(Keyword::Type) => self.type_block(&mut file.types),
            Some(Keyword::VarGlobal) => file.globals.push(self.section(Keyword::VarGlobal)),
            Some(word) if word.opens_variables() => {
                let section = self.section(word);
                unnamed.get_or_insert_with(|| unnamed_program(here)).sections.push(section);
            }
            Some(Keyword::Program) => file.units.push(self.pou(Keyword::Program, PouKind::Program)),
            Some(Keyword::Function) => file.units.push(self.pou(Keyword::Function, PouKind::Function)),
            Some(Keyword::FunctionBlock) => {
                file.units.push(self.pou(Keyword::FunctionBlock, PouKind::FunctionBlock));
            }
            Some(word) if word.ends_body() => {
                self.tell(Problem::new(here, format!("`{}` closes nothing", word.word())));
                self.advance();
                self.accept(Token::Semicolon);
            }
            _ if self.at_configuration() => self.configuration(file),
            _ => {
                let body = self.statements(Place::Body);
                if !body.is_empty() {
                    unnamed.get_or_insert_with(|| unnamed_program(here)).body.extend(body);
                }
            }
        }
    }

    /// Advances past a declaration that the language does not support, without leaving the open block.
    pub(super) fn skip_unsupported(&mut self) -> bool {
        let here = self.here();
        let text = self.text(here);
        if self.at_configuration() && !self.blocks.is_empty() {
            let problem = Problem::new(here, "CONFIGURATION is inside another declaration");
            self.tell(problem.help("is the end of the declaration above it missing?"));
            self.configuration(&mut File::default());
            return true;
        }
        let known = UNSUPPORTED.iter().find(|(word, _)| word.eq_ignore_ascii_case(text));
        let (Some((word, end)), Token::Name) = (known, self.peek(1)) else { return false };
        self.tell(Problem::new(here, format!("{word} is not supported")));
        while self.token() != Token::End && !self.keyword().is_some_and(|word| self.is_awaited(word)) {
            let span = self.advance();
            if self.text(span).eq_ignore_ascii_case(end) {
                break;
            }
        }
        true
    }

    fn pou(&mut self, opener: Keyword, kind: PouKind) -> Pou {
        let start = self.open(opener);
        let name = self.new_name(&format!("the name of a {}", opener.word()));
        let name = name.unwrap_or_else(|_| Name { text: String::new(), span: self.since(start) });
        let result = self.result(opener);
        self.accept(Token::Semicolon);
        self.skip_inheritance();
        let mut pou = Pou { kind, name, result, sections: Vec::new(), body: Vec::new(), span: start };
        loop {
            match self.keyword() {
                Some(word) if word.opens_variables() => {
                    if !pou.body.is_empty() {
                        let message = format!("{} is after statements", word.word());
                        let help = "sections of variables must be before the first statement";
                        self.tell(Problem::new(self.here(), message).help(help));
                    }
                    pou.sections.push(self.section(word));
                }
                Some(word) if word.ends_body() => break,
                _ if self.token() == Token::End => break,
                _ => pou.body.extend(self.statements(Place::Body)),
            }
        }
        self.close();
        pou.span = self.since(start);
        self.accept(Token::Semicolon);
        pou
    }

    /// `: type` after the name of a FUNCTION.
    fn result(&mut self, opener: Keyword) -> Option<TypeName> {
        let colon = self.here();
        if !self.accept(Token::Colon) {
            return None;
        }
        if opener != Keyword::Function {
            self.tell(Problem::new(colon, format!("a {} has no result", opener.word())));
        }
        self.type_name().ok()
    }

    fn skip_inheritance(&mut self) {
        let here = self.here();
        let text = self.text(here);
        let word = ["EXTENDS", "IMPLEMENTS"].into_iter().find(|word| word.eq_ignore_ascii_case(text));
        if let Some(word) = word.filter(|_| self.peek(1) == Token::Name) {
            self.tell(Problem::new(here, format!("{word} is not supported")));
            while matches!(self.token(), Token::Name | Token::Comma) {
                self.advance();
            }
        }
    }
}

/// The PROGRAM without a name, if its text is alone in the file.
fn unnamed_program(here: Span) -> Pou {
    let span = Span { start: here.start, end: here.start };
    let name = Name { text: String::new(), span };
    Pou { kind: PouKind::Program, name, result: None, sections: Vec::new(), body: Vec::new(), span }
}
