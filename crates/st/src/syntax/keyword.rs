//! The words of the language: reserved, in upper or lower case.

/// A reserved word. IEC 61131-3, 6.1.3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Keyword {
    Program,
    EndProgram,
    Function,
    EndFunction,
    FunctionBlock,
    EndFunctionBlock,
    Type,
    EndType,
    Struct,
    EndStruct,
    Var,
    VarInput,
    VarOutput,
    VarInOut,
    VarTemp,
    VarExternal,
    VarGlobal,
    EndVar,
    Retain,
    NonRetain,
    Persistent,
    Constant,
    At,
    Array,
    Of,
    If,
    Then,
    Elsif,
    Else,
    EndIf,
    Case,
    EndCase,
    For,
    To,
    By,
    Do,
    EndFor,
    While,
    EndWhile,
    Repeat,
    Until,
    EndRepeat,
    Exit,
    Continue,
    Return,
    And,
    Or,
    Xor,
    Not,
    Mod,
    True,
    False,
}

/// In the order of the variants.
const ROWS: [(Keyword, &str); 52] = [
    (Keyword::Program, "PROGRAM"),
    (Keyword::EndProgram, "END_PROGRAM"),
    (Keyword::Function, "FUNCTION"),
    (Keyword::EndFunction, "END_FUNCTION"),
    (Keyword::FunctionBlock, "FUNCTION_BLOCK"),
    (Keyword::EndFunctionBlock, "END_FUNCTION_BLOCK"),
    (Keyword::Type, "TYPE"),
    (Keyword::EndType, "END_TYPE"),
    (Keyword::Struct, "STRUCT"),
    (Keyword::EndStruct, "END_STRUCT"),
    (Keyword::Var, "VAR"),
    (Keyword::VarInput, "VAR_INPUT"),
    (Keyword::VarOutput, "VAR_OUTPUT"),
    (Keyword::VarInOut, "VAR_IN_OUT"),
    (Keyword::VarTemp, "VAR_TEMP"),
    (Keyword::VarExternal, "VAR_EXTERNAL"),
    (Keyword::VarGlobal, "VAR_GLOBAL"),
    (Keyword::EndVar, "END_VAR"),
    (Keyword::Retain, "RETAIN"),
    (Keyword::NonRetain, "NON_RETAIN"),
    (Keyword::Persistent, "PERSISTENT"),
    (Keyword::Constant, "CONSTANT"),
    (Keyword::At, "AT"),
    (Keyword::Array, "ARRAY"),
    (Keyword::Of, "OF"),
    (Keyword::If, "IF"),
    (Keyword::Then, "THEN"),
    (Keyword::Elsif, "ELSIF"),
    (Keyword::Else, "ELSE"),
    (Keyword::EndIf, "END_IF"),
    (Keyword::Case, "CASE"),
    (Keyword::EndCase, "END_CASE"),
    (Keyword::For, "FOR"),
    (Keyword::To, "TO"),
    (Keyword::By, "BY"),
    (Keyword::Do, "DO"),
    (Keyword::EndFor, "END_FOR"),
    (Keyword::While, "WHILE"),
    (Keyword::EndWhile, "END_WHILE"),
    (Keyword::Repeat, "REPEAT"),
    (Keyword::Until, "UNTIL"),
    (Keyword::EndRepeat, "END_REPEAT"),
    (Keyword::Exit, "EXIT"),
    (Keyword::Continue, "CONTINUE"),
    (Keyword::Return, "RETURN"),
    (Keyword::And, "AND"),
    (Keyword::Or, "OR"),
    (Keyword::Xor, "XOR"),
    (Keyword::Not, "NOT"),
    (Keyword::Mod, "MOD"),
    (Keyword::True, "TRUE"),
    (Keyword::False, "FALSE"),
];

const _: () = {
    let mut place = 0;
    while place < ROWS.len() {
        // The rows are in the order of the variants.
        assert!(ROWS[place].0 as usize == place);
        place += 1;
    }
};

impl Keyword {
    /// The word, in upper case.
    pub(crate) const fn word(self) -> &'static str {
        ROWS[self as usize].1
    }

    /// The keyword that equals `text`, in upper or lower case.
    pub(crate) fn of(text: &str) -> Option<Self> {
        ROWS.iter().find(|(_, word)| word.eq_ignore_ascii_case(text)).map(|(keyword, _)| *keyword)
    }

    /// The word that closes a block opened by this word.
    pub(crate) const fn closer(self) -> Option<Self> {
        Some(match self {
            Self::Program => Self::EndProgram,
            Self::Function => Self::EndFunction,
            Self::FunctionBlock => Self::EndFunctionBlock,
            Self::Type => Self::EndType,
            Self::Struct => Self::EndStruct,
            Self::If => Self::EndIf,
            Self::Case => Self::EndCase,
            Self::For => Self::EndFor,
            Self::While => Self::EndWhile,
            Self::Repeat => Self::EndRepeat,
            _ if self.opens_variables() => Self::EndVar,
            _ => return None,
        })
    }

    /// Whether it opens a section of variables.
    pub(crate) const fn opens_variables(self) -> bool {
        matches!(
            self,
            Self::Var
                | Self::VarInput
                | Self::VarOutput
                | Self::VarInOut
                | Self::VarTemp
                | Self::VarExternal
                | Self::VarGlobal
        )
    }

    /// Whether it opens a statement.
    pub(crate) const fn opens_statement(self) -> bool {
        matches!(
            self,
            Self::If
                | Self::Case
                | Self::For
                | Self::While
                | Self::Repeat
                | Self::Exit
                | Self::Continue
                | Self::Return
        )
    }

    /// Whether it ends a list of statements inside another statement.
    pub(crate) const fn ends_statements(self) -> bool {
        matches!(
            self,
            Self::Elsif
                | Self::Else
                | Self::EndIf
                | Self::EndCase
                | Self::EndFor
                | Self::EndWhile
                | Self::Until
                | Self::EndRepeat
        )
    }

    /// Whether it ends the statements of a program organization unit, or a section.
    pub(crate) const fn ends_body(self) -> bool {
        self.opens_variables()
            || matches!(
                self,
                Self::Program
                    | Self::EndProgram
                    | Self::Function
                    | Self::EndFunction
                    | Self::FunctionBlock
                    | Self::EndFunctionBlock
                    | Self::Type
                    | Self::EndType
                    | Self::EndVar
                    | Self::EndStruct
            )
    }
}
