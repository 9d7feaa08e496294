//! A program as written: names are not resolved, types are not known.

use crate::elementary::Elementary;
use crate::problem::Span;

/// A name as written; upper and lower case are equal (IEC 61131-3, 6.1.2).
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Name {
    pub(crate) text: String,
    pub(crate) span: Span,
}

/// A whole file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct File {
    pub(crate) types: Vec<TypeDeclaration>,
    pub(crate) units: Vec<Pou>,
    /// VAR_GLOBAL sections outside every program organization unit.
    pub(crate) globals: Vec<VarSection>,
    pub(crate) configurations: Vec<Configuration>,
}

/// `CONFIGURATION … END_CONFIGURATION`: which PROGRAMs run, and when. Its VAR_GLOBAL are those of the file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Configuration {
    pub(crate) tasks: Vec<TaskDeclaration>,
    pub(crate) programs: Vec<ProgramInstance>,
    /// Its first word.
    pub(crate) span: Span,
}

/// `TASK Fast(INTERVAL := T#1ms, PRIORITY := 1);`
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TaskDeclaration {
    pub(crate) name: Name,
    pub(crate) interval: Option<Expression>,
    pub(crate) priority: Option<Expression>,
}

/// `PROGRAM Lamp1 WITH Fast : Lamp;`
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ProgramInstance {
    pub(crate) name: Name,
    pub(crate) task: Option<Name>,
    pub(crate) program: Name,
}

impl File {
    /// Adds the contents of another file of the same program.
    pub(crate) fn append(&mut self, other: Self) {
        self.types.extend(other.types);
        self.units.extend(other.units);
        self.globals.extend(other.globals);
        self.configurations.extend(other.configurations);
    }
}

/// A program organization unit. A file that begins with statements or VAR sections outside all units is a
/// PROGRAM without a name: the manual prints its examples in this form.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pou {
    pub(crate) kind: PouKind,
    pub(crate) name: Name,
    /// For a FUNCTION that has one.
    pub(crate) result: Option<TypeName>,
    pub(crate) sections: Vec<VarSection>,
    pub(crate) body: Vec<Statement>,
    /// Its text, from its first word to its last.
    pub(crate) span: Span,
}

impl Pou {
    /// Whether it consists of the text in a file outside all other units.
    pub(crate) fn is_unnamed_program(&self) -> bool {
        self.kind == PouKind::Program && self.name.text.is_empty()
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PouKind {
    Program,
    Function,
    FunctionBlock,
}

/// `VAR … END_VAR`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VarSection {
    pub(crate) kind: VarKind,
    pub(crate) retain: bool,
    pub(crate) constant: bool,
    pub(crate) variables: Vec<VarDeclaration>,
    pub(crate) span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VarKind {
    Var,
    Input,
    Output,
    InOut,
    Temp,
    External,
    Global,
}

/// `a, b AT IOBus://unit#1/UDINT 01 C to M : UDINT := 0;` — one for each name.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VarDeclaration {
    pub(crate) name: Name,
    /// The path after AT, without the space around it.
    pub(crate) at: Option<Name>,
    pub(crate) type_name: TypeName,
    pub(crate) initial: Option<Initial>,
}

/// A type in use.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TypeName {
    pub(crate) kind: TypeKind,
    pub(crate) span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum TypeKind {
    Elementary(Elementary),
    /// STRING, STRING[10], STRING(10).
    String(Option<Box<Expression>>),
    /// ARRAY[0..14, 1..2] OF type; bounds are constant expressions.
    Array {
        bounds: Vec<(Expression, Expression)>,
        element: Box<TypeName>,
    },
    /// `ARRAY[*, *] OF type`, with its dimensions: an array of any length.
    OpenArray {
        dimensions: usize,
        element: Box<TypeName>,
    },
    /// A type of the user or of the library.
    Named(String),
}

/// `TYPE … END_TYPE`, one of the types in it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TypeDeclaration {
    pub(crate) name: Name,
    pub(crate) definition: TypeDefinition,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum TypeDefinition {
    /// STRUCT members END_STRUCT; members have no AT.
    Struct(Vec<VarDeclaration>),
    /// (red, green := 5, blue) := green, optionally with an elementary base type before or after, which is read
    /// and ignored if it is an integer.
    Enum { values: Vec<(Name, Option<Expression>)>, initial: Option<Name> },
    /// Another name for a type, with a separate initial value.
    Alias { type_name: TypeName, initial: Option<Initial> },
}

/// An initial value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Initial {
    Expression(Expression),
    /// `[1, 2, 3(0)]`.
    Array {
        elements: Vec<InitialElement>,
        span: Span,
    },
    /// `(x := 1, y := 2)`.
    Struct {
        members: Vec<(Name, Initial)>,
        span: Span,
    },
}

/// An element of an array's initial value: the repeat count, and the value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InitialElement {
    /// `3(0)`: a constant expression.
    pub(crate) repeat: Option<Expression>,
    pub(crate) value: Initial,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Statement {
    pub(crate) kind: StatementKind,
    pub(crate) span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum StatementKind {
    /// `;` alone, once for several in a row; also a statement that could not be read, which has been reported.
    Empty,
    Assign {
        to: Expression,
        value: Expression,
    },
    /// A call of a function block or of a function whose result is not used.
    Call(Call),
    If {
        branches: Vec<(Expression, Vec<Statement>)>,
        otherwise: Vec<Statement>,
    },
    Case {
        selector: Expression,
        arms: Vec<CaseArm>,
        otherwise: Vec<Statement>,
    },
    For {
        variable: Expression,
        from: Expression,
        to: Expression,
        by: Option<Expression>,
        body: Vec<Statement>,
    },
    While {
        condition: Expression,
        body: Vec<Statement>,
    },
    Repeat {
        body: Vec<Statement>,
        until: Expression,
    },
    Exit,
    Continue,
    Return,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CaseArm {
    pub(crate) labels: Vec<CaseLabel>,
    pub(crate) body: Vec<Statement>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum CaseLabel {
    Value(Expression),
    Range(Expression, Expression),
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Expression {
    pub(crate) kind: ExpressionKind,
    pub(crate) span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ExpressionKind {
    Literal(Literal),
    /// A variable, an enumeration value, or a function without arguments.
    Name(String),
    /// `motor.speed`.
    Member {
        of: Box<Expression>,
        member: Name,
    },
    /// `table[1, 2]`.
    Index {
        of: Box<Expression>,
        indices: Vec<Expression>,
    },
    /// `Colour#red`: an enumeration value with its type.
    EnumValue {
        type_name: Name,
        value: Name,
    },
    Unary {
        operator: UnaryOperator,
        operand: Box<Expression>,
    },
    Binary {
        operator: BinaryOperator,
        left: Box<Expression>,
        right: Box<Expression>,
    },
    Call(Call),
}

/// A call; the called expression is a name or, for function blocks, a member or element.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Call {
    pub(crate) callee: Box<Expression>,
    pub(crate) arguments: Vec<Argument>,
    pub(crate) span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Argument {
    /// `f(x)`.
    Positional(Expression),
    /// `f(In := x)`.
    Input { name: Name, value: Expression },
    /// `f(Q => x)`, `f(NOT Q => x)`; without a target after the arrow the output is ignored.
    Output { name: Name, negated: bool, to: Option<Expression> },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum UnaryOperator {
    Minus,
    Plus,
    Not,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BinaryOperator {
    Power,
    Multiply,
    Divide,
    Modulo,
    Add,
    Subtract,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Equal,
    NotEqual,
    And,
    Xor,
    Or,
}

/// A literal; numbers are without their sign, which is a unary operator.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Literal {
    /// `TRUE`, `FALSE`.
    Bool(bool),
    /// `15`, `16#FF`, `1_000`: matches every integer and bit string type that can hold it.
    Integer(u64),
    /// `1.5`, `1.0E-3`: REAL or LREAL.
    Real(f64),
    /// `INT#-5`, `WORD#16#FF`, `BOOL#1`, `REAL#1.5`, `10#15` is an Integer: of this type and no other.
    Typed { elementary: Elementary, value: TypedValue },
    /// `T#1h30m`, `TIME#-5ms`: nanoseconds.
    Time(i64),
    /// `'text'`, bytes with the `$` escapes resolved.
    String(Vec<u8>),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TypedValue {
    /// For an integer, a bit string or a BOOL, with its sign: it fits the type (the parser has checked).
    Integer(i128),
    /// For REAL or LREAL.
    Real(f64),
}
