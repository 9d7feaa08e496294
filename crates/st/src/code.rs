//! What a program is made into before it runs: names are slots, types are settled, conversions are written out.

use crate::elementary::Elementary;
use crate::library::Native;
use crate::operators::{Binary, Unary};
use crate::problem::Span;

/// A slot of the memory.
pub(crate) type Slot = u32;

/// An expression. Its value is 64 bits: of an elementary value what [`crate::value`] says, of everything else the
/// slot where it begins.
#[derive(Clone, Debug)]
pub(crate) enum Code {
    Constant(u64),
    /// The value in one slot.
    Load(Place),
    /// The slot where a variable begins.
    Address(Place),
    Unary {
        operator: Unary,
        elementary: Elementary,
        operand: Box<Code>,
    },
    Binary {
        operator: Binary,
        elementary: Elementary,
        operands: Box<(Code, Code)>,
    },
    /// AND and OR of BOOLs: the right operand is left aside when the left one decides.
    Decide {
        stop_at: bool,
        operands: Box<(Code, Code)>,
    },
    /// Two STRINGs compared.
    CompareText {
        operator: Binary,
        operands: Box<(Code, Code)>,
    },
    Convert {
        from: Elementary,
        to: Elementary,
        operand: Box<Code>,
    },
    Call(Box<FunctionCall>),
    Native(Box<NativeCall>),
}

/// Where a variable lies.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    pub(crate) base: Base,
    pub(crate) offset: u32,
    pub(crate) indices: Vec<Element>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Base {
    /// The memory's beginning.
    Memory,
    /// The beginning of the function block instance whose body runs.
    Instance,
    /// What the slot behind the offset of this base names: a VAR_IN_OUT.
    ReferenceInMemory(Slot),
    /// The same, counted from the instance.
    ReferenceInInstance(u32),
}

/// An element of an array, by an index for each dimension.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) dimensions: Vec<Dimension>,
    pub(crate) element_slots: u32,
    pub(crate) extent: Extent,
}

/// How many elements an array has in all its dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    Fixed(u32),
    /// An array of any length: its bounds lie behind the reference at which the place begins.
    Open {
        dimensions: u32,
    },
}

#[derive(Clone, Debug)]
pub(crate) struct Dimension {
    pub(crate) index: Code,
    /// Type of the index.
    pub(crate) elementary: Elementary,
    /// The bounds; of an array of any length they and the stride say nothing.
    pub(crate) lower: i64,
    pub(crate) upper: i64,
    /// How many elements one step of this index is.
    pub(crate) stride: u32,
    pub(crate) span: Span,
}

/// How a value is put into its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Put {
    /// One slot; the code's value is stored.
    Value,
    /// So many slots from the slot that the code names.
    Slots(u32),
    /// A STRING from the slot that the code names; the target holds so many characters.
    Text(u16),
    /// A reference and the number of a layout: two slots.
    Any { layout: u32 },
}

#[derive(Clone, Debug)]
pub(crate) struct Statement {
    pub(crate) kind: StatementKind,
    pub(crate) span: Span,
}

#[derive(Clone, Debug)]
pub(crate) enum StatementKind {
    Assign(Assign),
    /// A function whose result is not used.
    Evaluate(Code),
    CallBlock(BlockCall),
    If {
        branches: Vec<(Code, Vec<Statement>)>,
        otherwise: Vec<Statement>,
    },
    Case {
        selector: Case,
        arms: Vec<CaseArm>,
        otherwise: Vec<Statement>,
    },
    For(For),
    While {
        condition: Code,
        body: Vec<Statement>,
    },
    Repeat {
        body: Vec<Statement>,
        until: Code,
    },
    Exit,
    Continue,
    Return,
}

#[derive(Clone, Debug)]
pub(crate) struct Assign {
    pub(crate) to: Place,
    pub(crate) value: Code,
    pub(crate) put: Put,
}

/// What a CASE looks at.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) value: Code,
    pub(crate) elementary: Elementary,
}

#[derive(Clone, Debug)]
pub(crate) struct CaseArm {
    /// Ranges of values, both ends in them.
    pub(crate) labels: Vec<(i128, i128)>,
    pub(crate) body: Vec<Statement>,
}

#[derive(Clone, Debug)]
pub(crate) struct For {
    pub(crate) variable: Place,
    pub(crate) elementary: Elementary,
    pub(crate) from: Code,
    pub(crate) to: Code,
    pub(crate) by: Code,
    pub(crate) body: Vec<Statement>,
}

/// A call of a function of the program. Functions never call themselves, so each has one set of variables.
#[derive(Clone, Debug)]
pub(crate) struct FunctionCall {
    pub(crate) unit: u32,
    pub(crate) inputs: Vec<(Slot, Code, Put)>,
    /// Taken from the function's variables when it has run.
    pub(crate) outputs: Vec<Assign>,
    /// The result: its slot and how it is given on.
    pub(crate) result: FunctionResult,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum FunctionResult {
    None,
    /// The value in this slot.
    Value(Slot),
    /// So many slots, copied to a place of the caller's own: a later call would write over them.
    Copied {
        from: Slot,
        to: Slot,
        slots: u32,
    },
}

/// A call of a function of the library.
#[derive(Clone, Debug)]
pub(crate) struct NativeCall {
    pub(crate) native: Native,
    /// The type that its generic inputs have in this call.
    pub(crate) elementary: Elementary,
    pub(crate) arguments: Vec<NativeArgument>,
    /// Where a STRING result goes, and the most characters that fit there.
    pub(crate) text: (Slot, u16),
}

#[derive(Clone, Debug)]
pub(crate) enum NativeArgument {
    /// One argument: the value; of a STRING the slot where it begins.
    Value(Code),
    /// One argument: where a variable of one slot lies, to be read and written; or a STRING or enumeration.
    Reference(Place),
    /// Three arguments: where an element lies, how many elements there are from it on, how many slots each has.
    /// Of what is no element of an array there is one.
    Elements { place: Place, element_slots: u32, in_array: bool },
    /// Two arguments: where a variable lies, and its layout's number; both stand in a reference of the type ANY.
    Any(Place),
}

#[derive(Clone, Debug)]
pub(crate) struct BlockCall {
    pub(crate) unit: u32,
    pub(crate) instance: Place,
    /// Offset in the instance, and what is put there.
    pub(crate) inputs: Vec<(u32, Code, Put)>,
    /// Offset in the instance, whether it is negated, and where it goes; a conversion is written out in `convert`.
    pub(crate) outputs: Vec<BlockOutput>,
}

#[derive(Clone, Debug)]
pub(crate) struct BlockOutput {
    pub(crate) offset: u32,
    pub(crate) convert: Option<(Elementary, Elementary)>,
    pub(crate) negated: bool,
    pub(crate) to: Place,
    pub(crate) put: Put,
}

/// The code of a program organization unit.
#[derive(Clone, Debug, Default)]
pub(crate) struct Unit {
    pub(crate) body: Vec<Statement>,
    /// Slots in the memory that get their initial values at each call: variables of a function, VAR_TEMP.
    pub(crate) fresh: Vec<core::ops::Range<Slot>>,
    /// Whether its places lie in the library's text, and not in the program's.
    pub(crate) is_library: bool,
}
