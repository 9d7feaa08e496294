//! The compiled form of a program: names are slots, types are resolved, conversions are explicit.

use crate::elementary::Elementary;
use crate::library::Native;
use crate::memory::Slot;
use crate::operators::{Binary, Unary};
use crate::problem::Span;
use crate::types::Extent;

/// An expression. Its value is 64 bits: for an elementary value as in [`crate::value`], for everything else the
/// slot at which it begins.
#[derive(Clone, Debug)]
pub(crate) enum Code {
    Constant(u64),
    /// The value in one slot.
    Load(Place),
    /// The slot at which a variable begins.
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
    /// AND and OR of BOOLs: the right operand is not evaluated if the left one determines the result.
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

/// The position of a variable.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    pub(crate) base: Base,
    pub(crate) offset: u32,
    pub(crate) indices: Vec<Element>,
}

impl Place {
    /// A variable with a fixed position.
    pub(crate) const fn in_memory(slot: Slot) -> Self {
        Self { base: Base::Memory, offset: slot, indices: Vec::new() }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Base {
    /// The start of the memory.
    Memory,
    /// The start of the function block instance whose body is executed.
    Instance,
    /// The position stored in the slot at the offset of this base: a VAR_IN_OUT.
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

#[derive(Clone, Debug)]
pub(crate) struct Dimension {
    pub(crate) index: Code,
    /// Type of the index.
    pub(crate) elementary: Elementary,
    /// The bounds; for an array of any length they and the stride are not used.
    pub(crate) lower: i64,
    pub(crate) upper: i64,
    /// Number of elements per step of this index.
    pub(crate) stride: u32,
    pub(crate) span: Span,
}

/// How a value is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Put {
    /// One slot; the code's value is stored.
    Value,
    /// This number of slots from the slot in the code's value.
    Slots(u32),
    /// A STRING from the slot in the code's value; the target holds this number of characters.
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

/// The selector of a CASE.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) value: Code,
    pub(crate) elementary: Elementary,
}

#[derive(Clone, Debug)]
pub(crate) struct CaseArm {
    /// Ranges of values, including both ends.
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
    /// Outputs that are copied after its execution, because a later call would overwrite them.
    pub(crate) kept: Vec<SlotCopy>,
    /// Taken from the function's variables, or from the copies, after its execution.
    pub(crate) outputs: Vec<Assign>,
    /// The result: its slot and how it is returned.
    pub(crate) result: FunctionResult,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum FunctionResult {
    None,
    /// The value in this slot.
    Value(Slot),
    /// Slots, copied to a separate position of the caller: a later call would overwrite them.
    Copied(SlotCopy),
}

/// A number of slots that are copied.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlotCopy {
    pub(crate) from: Slot,
    pub(crate) to: Slot,
    pub(crate) slots: u32,
}

/// A call of a function of the library.
#[derive(Clone, Debug)]
pub(crate) struct NativeCall {
    pub(crate) native: Native,
    /// The type of its generic inputs in this call.
    pub(crate) elementary: Elementary,
    pub(crate) arguments: Vec<NativeArgument>,
    /// The position of a STRING result, and the maximum number of characters there.
    pub(crate) text: (Slot, u16),
}

#[derive(Clone, Debug)]
pub(crate) enum NativeArgument {
    /// One argument: the value; for a STRING the slot at which it begins.
    Value(Code),
    /// One argument: an integer of the type ULINT where every integer type is accepted.
    Ulint(Code),
    /// One argument: the position of a variable of one slot, to be read and written; or of a STRING or enumeration.
    Reference(Place),
    /// Three arguments: the position of an element, the number of elements from it on, the number of slots of
    /// each. For a variable that is not an element of an array, the number of elements is one.
    Elements { place: Place, element_slots: u32, in_array: bool },
    /// Two arguments: the position of a variable, and the number of its layout; both are stored in a reference
    /// of the type ANY.
    Any(Place),
}

#[derive(Clone, Debug)]
pub(crate) struct BlockCall {
    pub(crate) unit: u32,
    pub(crate) instance: Place,
    /// Offset in the instance, and the value stored there.
    pub(crate) inputs: Vec<(u32, Code, Put)>,
    /// Outputs that are copied after its execution, from their offsets in the instance.
    pub(crate) kept: Vec<SlotCopy>,
    /// Offset in the instance, whether it is negated, and its target; a conversion is explicit in `convert`.
    pub(crate) outputs: Vec<BlockOutput>,
}

#[derive(Clone, Debug)]
pub(crate) struct BlockOutput {
    pub(crate) offset: u32,
    /// The position of its copy, if it is copied.
    pub(crate) kept: Option<Slot>,
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
    /// Whether its source positions are in the library's text, and not in the program's.
    pub(crate) is_library: bool,
}

/// PROGRAMs that run together.
#[derive(Clone, Debug)]
pub(crate) struct Task {
    /// In each scan, or in every n-th scan, where n is this number.
    pub(crate) every: u64,
    /// Their units, in the order in which they run.
    pub(crate) programs: Vec<u32>,
}
