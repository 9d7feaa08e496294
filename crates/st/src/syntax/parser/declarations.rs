//! Sections of variables, and the declarations in them.

use super::super::ast::{Name, VarDeclaration, VarKind, VarSection};
use super::super::keyword::Keyword;
use super::super::literal;
use super::super::token::Token;
use super::{Parsed, Parser};
use crate::SOURCE_BYTES_MAX;
use crate::problem::{Problem, Span};

/// The owner of the declarations that are read.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Owner {
    Section,
    Struct,
}

impl Owner {
    fn closer(self) -> Keyword {
        match self {
            Self::Section => Keyword::EndVar,
            Self::Struct => Keyword::EndStruct,
        }
    }
}

impl Parser<'_> {
    /// `VAR … END_VAR`, with the word that opens it.
    pub(super) fn section(&mut self, opener: Keyword) -> VarSection {
        let start = self.open(opener);
        let kind = match opener {
            Keyword::VarInput => VarKind::Input,
            Keyword::VarOutput => VarKind::Output,
            Keyword::VarInOut => VarKind::InOut,
            Keyword::VarTemp => VarKind::Temp,
            Keyword::VarExternal => VarKind::External,
            Keyword::VarGlobal => VarKind::Global,
            _ => VarKind::Var,
        };
        let mut section =
            VarSection { kind, retain: false, constant: false, variables: Vec::new(), span: start };
        while self.qualifier(&mut section) {}
        section.variables = self.declarations(Owner::Section);
        self.close();
        section.span = self.since(start);
        self.accept(Token::Semicolon);
        section
    }

    fn qualifier(&mut self, section: &mut VarSection) -> bool {
        match self.keyword() {
            Some(Keyword::Retain | Keyword::Persistent) => section.retain = true,
            Some(Keyword::Constant) => section.constant = true,
            Some(Keyword::NonRetain) => {}
            _ => return false,
        }
        self.advance();
        true
    }

    /// Declarations up to the end of the section or structure.
    pub(super) fn declarations(&mut self, owner: Owner) -> Vec<VarDeclaration> {
        let mut variables = Vec::new();
        loop {
            self.mend_closer(owner);
            if self.declarations_end(owner) {
                return variables;
            }
            let before = self.place;
            if self.declaration(owner, &mut variables).is_err() {
                self.recover();
            }
            if self.place == before {
                self.advance();
                self.accept(Token::Semicolon);
            }
        }
    }

    /// Recognizes a misspelt end, such as `ENDVAR`: a declaration has other tokens after its name.
    fn mend_closer(&mut self, owner: Owner) {
        let is_declared =
            matches!(self.peek(1), Token::Colon | Token::Comma | Token::Assign | Token::Keyword(Keyword::At));
        if self.token() == Token::Name && !is_declared {
            self.mend(&[owner.closer()]);
        }
    }

    fn declarations_end(&self, owner: Owner) -> bool {
        let closer = owner.closer();
        match self.token() {
            Token::End => true,
            Token::Keyword(word) if word.ends_body() => true,
            Token::Keyword(word) => {
                (word.opens_statement() || word.ends_statements()) && !self.comes_before_others(closer)
            }
            // A statement: either the end of the section is missing, or a type.
            Token::Name => {
                let is_statement = matches!(
                    self.peek(1),
                    Token::Assign | Token::OpenParenthesis | Token::Dot | Token::OpenBracket
                );
                is_statement && !self.comes_before_others(closer)
            }
            _ => false,
        }
    }

    /// Whether `closer` is the next word that ends a body or a section.
    fn comes_before_others(&self, closer: Keyword) -> bool {
        let rest = self.lexemes.get(self.place..).unwrap_or_default();
        let mut words = rest.iter().filter_map(|lexeme| match lexeme.token {
            Token::Keyword(word) => Some(word),
            _ => None,
        });
        words.find(|word| word.ends_body()) == Some(closer)
    }

    fn declaration(&mut self, owner: Owner, variables: &mut Vec<VarDeclaration>) -> Parsed<()> {
        let what = if owner == Owner::Section { "the name of a variable" } else { "the name of a member" };
        let mut names = vec![self.new_name(what)?];
        while self.accept(Token::Comma) {
            names.push(self.new_name(what)?);
        }
        let at = if self.at(Keyword::At) { self.location(owner, names.len())? } else { None };
        let told = self.colon(names.last());
        told?;
        let start = self.here();
        let type_name = self.type_name()?;
        let initial = if self.assign_sign() { Some(self.initial()?) } else { None };
        let size_bytes = self.since(start).range().len();
        if names.len() > 1 && names.len().saturating_mul(size_bytes) > SOURCE_BYTES_MAX {
            return self.fail(Problem::new(start, "too many names share a declaration of this length"));
        }
        let what = format!("the declaration of `{}`", names.first().map_or("", |name| name.text.as_str()));
        variables.extend(names.into_iter().map(|name| VarDeclaration {
            name,
            at: at.clone(),
            type_name: type_name.clone(),
            initial: initial.clone(),
        }));
        self.semicolon(&what).or_else(|failed| if self.begins_declaration() { Ok(()) } else { Err(failed) })
    }

    /// Whether the next declaration, or the end, is at the position of a missing semicolon.
    fn begins_declaration(&self) -> bool {
        let begins = matches!(self.peek(1), Token::Colon | Token::Comma | Token::Keyword(Keyword::At));
        matches!(self.token(), Token::Keyword(_) | Token::End) || (self.token() == Token::Name && begins)
    }

    fn colon(&mut self, name: Option<&Name>) -> Parsed<()> {
        if self.accept(Token::Colon) {
            return Ok(());
        }
        let name = name.map_or("", |name| name.text.as_str());
        let mut problem = self.missing(&format!("`:` and a type after `{name}`"));
        if self.token() == Token::Assign {
            problem = problem.help(format!("a variable is declared as `{name} : INT := 5;`"));
        }
        self.fail(problem)
    }

    /// `:=` before an initial value; `=` is read as `:=`.
    pub(super) fn assign_sign(&mut self) -> bool {
        let here = self.here();
        if self.accept(Token::Equal) {
            self.tell(Problem::new(here, "expected `:=`, found `=`").help("an initial value follows `:=`"));
            return true;
        }
        self.accept(Token::Assign)
    }

    /// The path after AT.
    fn location(&mut self, owner: Owner, names: usize) -> Parsed<Option<Name>> {
        let word = self.advance();
        let span = self.here();
        let path = match self.token() {
            Token::Path => Some(self.text(span).to_owned()),
            Token::String => {
                self.string_literal(span).map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
            }
            Token::Direct => {
                let help = "use AT IOBus://… or the variable's name";
                self.tell(Problem::new(span, "directly represented variables are not supported").help(help));
                None
            }
            _ => {
                let problem =
                    self.missing("a path after AT").help("for example AT IOBus://unit#1/UINTs 01 M to C");
                return self.fail(problem);
            }
        };
        self.advance();
        if owner == Owner::Struct {
            self.tell(Problem::new(word, "a member of a structure has no AT"));
        } else if names > 1 {
            self.tell(Problem::new(word, "AT is permitted after one name, not after several"));
        }
        Ok(path.map(|text| Name { text, span }))
    }

    /// The bytes of the string at `span`; mistakes in it are reported.
    pub(super) fn string_literal(&mut self, span: Span) -> Option<Vec<u8>> {
        match literal::string(self.text(span), span) {
            Ok(bytes) => Some(bytes),
            Err(problem) => {
                self.tell(problem);
                None
            }
        }
    }
}
