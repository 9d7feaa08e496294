//! The names of types, and their meanings.

use std::sync::Arc;

use super::constants::Constants;
use super::scope::{Scope, key};
use super::{Checker, Named, Origin, SLOTS_MAX, Shape};
use crate::library;
use crate::problem::{Problem, Span};
use crate::syntax::ast::{
    Expression, File, Name, PouKind, TypeDeclaration, TypeDefinition, TypeKind, TypeName, VarDeclaration,
};
use crate::types::*;

/// Maximum number of slots of all types together.
const TYPE_SLOTS_MAX: usize = 8 * SLOTS_MAX as usize;

/// Maximum nesting depth of types.
const TYPE_DEPTH_MAX: u32 = 32;

/// Maximum number of members of a structure and of values of an enumeration, as in an NJ/NX-series CPU Unit;
/// maximum number of variables of a block.
const NAMES_MAX: usize = 2048;

/// Types of the standard that the CPU Unit does not have, and their replacements. Their names are free.
const FOREIGN_TYPES: &[(&str, &str)] = &[
    ("LTIME", "TIME"),
    ("LDATE", "DATE"),
    ("LTOD", "TIME_OF_DAY"),
    ("LTIME_OF_DAY", "TIME_OF_DAY"),
    ("LDT", "DATE_AND_TIME"),
    ("LDATE_AND_TIME", "DATE_AND_TIME"),
    ("CHAR", "STRING[2]"),
    ("WCHAR", "STRING[2]"),
    ("WSTRING", "STRING"),
];

/// Maximum number of dimensions of an array.
const DIMENSIONS_MAX: usize = 3;

impl<'t> Checker<'t> {
    /// Adds the names of a file's types and program organization units.
    pub(super) fn enter(&mut self, file: &'t File, origin: Origin) {
        for declaration in &file.types {
            self.enter_name(&declaration.name, Named::Type(declaration), origin);
        }
        for pou in file.units.iter().filter(|pou| !pou.name.text.is_empty()) {
            let named = match pou.kind {
                PouKind::Program => Named::Program,
                PouKind::Function => Named::Function(pou),
                PouKind::FunctionBlock => Named::Block(pou, origin),
            };
            self.enter_name(&pou.name, named, origin);
        }
    }

    /// Resolves the enumerations of a file: their values are used without their types.
    pub(super) fn resolve_enumerations(&mut self, file: &'t File) {
        let enumerations = file.types.iter().filter(|declaration| is_enumeration(declaration));
        for declaration in enumerations {
            self.named_shape(&declaration.name.text, declaration.name.span);
        }
    }

    /// Resolves the types of a file, including unused ones.
    pub(super) fn resolve_types(&mut self, file: &'t File) {
        for declaration in &file.types {
            if !self.is_given_up() {
                self.named_shape(&declaration.name.text, declaration.name.span);
            }
        }
    }

    /// Whether a type consists of function block instances, as far as this is known before it is resolved.
    pub(super) fn is_of_blocks(&self, kind: &TypeKind, level: u32) -> bool {
        match kind {
            _ if level > TYPE_DEPTH_MAX => false,
            TypeKind::Array { element, .. } => self.is_of_blocks(&element.kind, level + 1),
            TypeKind::Named(name) => match self.named.get(&key(name)) {
                Some(Named::Block(..)) => true,
                Some(Named::Type(declaration)) => match &declaration.definition {
                    TypeDefinition::Alias { type_name, .. } => self.is_of_blocks(&type_name.kind, level + 1),
                    _ => false,
                },
                _ => false,
            },
            _ => false,
        }
    }

    fn enter_name(&mut self, name: &Name, named: Named<'t>, origin: Origin) {
        let taken = library::function(&name.text).is_some()
            || library::Conversion::named(&name.text).is_some()
            || self.named.contains_key(&key(&name.text));
        if taken {
            let message = format!("the name `{}` is taken", name.text);
            let problem = Problem::new(name.span, message);
            let problem = problem.help("each type, function and block needs a different name");
            let first = self.first_places.get(&key(&name.text)).copied();
            self.refuse::<()>(Problem { first, ..problem });
        } else {
            self.named.insert(key(&name.text), named);
            if origin == Origin::User {
                self.first_places.insert(key(&name.text), name.span);
            }
        }
    }

    /// The type for a type name; none if it is wrong, which has been reported.
    pub(super) fn shape(&mut self, type_name: &TypeName, scope: &Scope) -> Option<Shape> {
        match &type_name.kind {
            TypeKind::Elementary(elementary) => Some(Shape::zero(Type::Elementary(*elementary))),
            TypeKind::String(None) => Some(Shape::zero(Type::String(STRING_CHARACTERS_DEFAULT))),
            TypeKind::String(Some(length)) => self.string(length, scope),
            TypeKind::Array { bounds, element } => self.array(type_name.span, bounds, element, scope),
            TypeKind::OpenArray { .. } => {
                let problem = Problem::new(type_name.span, "an array of any length is a VAR_IN_OUT");
                self.refuse(problem.help("declare it with bounds: ARRAY[0..9]"))
            }
            TypeKind::Named(name) if self.origin == Origin::Library && name.eq_ignore_ascii_case("ANY") => {
                Some(Shape::zero(Type::Any))
            }
            TypeKind::Named(name) => self.named_shape(name, type_name.span),
        }
    }

    /// The type of a VAR_IN_OUT, which may be an array of any length.
    pub(super) fn in_out_shape(&mut self, type_name: &TypeName, scope: &Scope) -> Option<Shape> {
        let TypeKind::OpenArray { dimensions, element } = &type_name.kind else {
            return self.shape(type_name, scope);
        };
        self.limit_dimensions(*dimensions, type_name.span)?;
        let element = self.shape(element, scope)?.type_;
        let array = OpenArray { dimensions: *dimensions, element };
        Some(Shape { type_: Type::Open(Arc::new(array)), initial: Vec::new() })
    }

    fn limit_dimensions(&mut self, dimensions: usize, span: Span) -> Option<()> {
        if dimensions <= DIMENSIONS_MAX {
            return Some(());
        }
        let message = format!("an array has {DIMENSIONS_MAX} dimensions at most, not {dimensions}");
        self.refuse(Problem::new(span, message))
    }

    fn string(&mut self, length: &Expression, scope: &Scope) -> Option<Shape> {
        let size_bytes = self.constant_integer(length, scope)?;
        match u16::try_from(size_bytes) {
            Ok(size_bytes @ 1..=STRING_BYTES_MAX) => Some(Shape::zero(Type::String(size_bytes - 1))),
            _ => self.refuse(
                Problem::new(
                    length.span,
                    format!("a STRING has 1 to {STRING_BYTES_MAX} bytes, not {size_bytes}"),
                )
                .help("the NUL at the end of the text is one of them"),
            ),
        }
    }

    fn array(
        &mut self,
        span: Span,
        bounds: &[(Expression, Expression)],
        element: &TypeName,
        scope: &Scope,
    ) -> Option<Shape> {
        self.limit_dimensions(bounds.len(), span)?;
        let element = self.shape(element, scope)?;
        let mut bound_list = Vec::new();
        // A structure without members takes no slots, but its arrays are limited nevertheless.
        let mut slots = i128::from(element.type_.slots().max(1));
        for (lower, upper) in bounds {
            let span = lower.span.to(upper.span);
            let lower = self.constant_integer(lower, scope)?;
            let upper = self.constant_integer(upper, scope)?;
            if upper < lower {
                let message = format!("the bounds {lower}..{upper} contain no element");
                return self.refuse(Problem::new(span, message).help("the lower bound comes first"));
            }
            slots = slots.saturating_mul(upper - lower + 1);
            let (Ok(lower), Ok(upper), true) =
                (i64::try_from(lower), i64::try_from(upper), slots <= SLOTS_MAX.into())
            else {
                let message =
                    format!("the array is larger than the {SLOTS_MAX} values that a program may have");
                return self.refuse(Problem::new(span, message));
            };
            bound_list.push(Bound { lower, upper });
        }
        let array = Array { bounds: bound_list, element: element.type_ };
        let initial = element.initial.repeat(array.elements() as usize);
        Some(Shape { type_: Type::Array(Arc::new(array)), initial })
    }

    /// The type with this name.
    pub(super) fn named_shape(&mut self, name: &str, span: Span) -> Option<Shape> {
        let Some(named) = self.named.get_mut(&key(name)) else {
            return self.unknown_type(name, span);
        };
        match named {
            Named::Shape(shape) => return Some(shape.clone()),
            Named::Wrong => return None,
            Named::Resolving => {
                let message = format!("`{name}` contains itself");
                return self.refuse(Problem::new(span, message));
            }
            Named::Function(_) | Named::Signature(_) => {
                let message = format!("`{name}` is a function, not a type");
                let help = "a function is called by its name and has no instances";
                return self.refuse(Problem::new(span, message).help(help));
            }
            Named::Program => {
                return self.refuse(Problem::new(span, format!("`{name}` is a program, not a type")));
            }
            Named::Type(_) | Named::Block(..) => {}
        }
        if self.type_depth == TYPE_DEPTH_MAX {
            let message = format!("types are nested more than {TYPE_DEPTH_MAX} levels deep");
            return self.refuse(Problem::new(span, message));
        }
        let named = core::mem::replace(named, Named::Resolving);
        self.type_depth += 1;
        let shape = match named {
            Named::Type(declaration) => self.define(declaration),
            Named::Block(pou, origin) => self.block_shape(pou, origin),
            _ => None,
        };
        self.type_depth -= 1;
        let shape = shape.and_then(|shape| self.limit_types(shape, span));
        self.named.insert(key(name), shape.clone().map_or(Named::Wrong, Named::Shape));
        shape
    }

    /// Refuses types that are too large together: an initial value of each is stored.
    fn limit_types(&mut self, shape: Shape, span: Span) -> Option<Shape> {
        self.type_slots += shape.initial.len();
        if self.type_slots <= TYPE_SLOTS_MAX {
            return Some(shape);
        }
        let message =
            format!("the types of the program are larger than {TYPE_SLOTS_MAX} values all together");
        self.refuse(Problem::new(span, message))
    }

    fn unknown_type(&mut self, name: &str, span: Span) -> Option<Shape> {
        let foreign = FOREIGN_TYPES.iter().find(|(foreign, _)| foreign.eq_ignore_ascii_case(name));
        if let Some((foreign, instead)) = foreign {
            let problem = Problem::new(span, format!("{foreign} is not supported"));
            return self.refuse(problem.help(format!("use {instead}")));
        }
        let types = self.named.iter().filter(|(_, named)| {
            matches!(named, Named::Type(_) | Named::Block(..) | Named::Shape(_) | Named::Resolving)
        });
        let names = types.map(|(name, _)| name.clone());
        let elementary =
            crate::elementary::Elementary::ALL.iter().map(|elementary| elementary.name().to_owned());
        let near = super::unknown_names::nearest(name, names.chain(elementary));
        let problem = Problem::new(span, format!("there is no type `{name}`"));
        self.refuse(match near {
            Some(near) => problem.did_you_mean(near),
            None => problem,
        })
    }

    fn define(&mut self, declaration: &TypeDeclaration) -> Option<Shape> {
        match &declaration.definition {
            TypeDefinition::Struct(members) => self.structure(&declaration.name, members),
            TypeDefinition::Enum { values, initial } => {
                self.enumeration(&declaration.name, values, initial.as_ref())
            }
            TypeDefinition::Alias { type_name, initial } => {
                let shape = self.shape(type_name, &Scope::default())?;
                self.with_initial(shape, initial.as_ref(), &Scope::default())
            }
        }
    }

    fn structure(&mut self, name: &Name, declarations: &[VarDeclaration]) -> Option<Shape> {
        let scope = Scope::default();
        self.limit_names("members", declarations.len(), name.span)?;
        let (mut members, mut initial) = (Vec::<Member>::new(), Vec::new());
        for declaration in declarations {
            let shape = self.shape(&declaration.type_name, &scope)?;
            let shape = self.with_initial(shape, declaration.initial.as_ref(), &scope)?;
            if shape.type_.holds_blocks() {
                let message = "a structure cannot contain a function block instance";
                return self.refuse(Problem::new(declaration.type_name.span, message));
            }
            if member(&members, &declaration.name.text).is_some() {
                let message = format!("the structure has a member `{}` already", declaration.name.text);
                return self.refuse(Problem::new(declaration.name.span, message));
            }
            let offset = initial.len() as u32;
            initial.extend(shape.initial);
            self.limit(initial.len(), declaration.type_name.span)?;
            let name = declaration.name.text.clone();
            members.push(Member { name, type_: shape.type_, offset, role: Role::Internal, retain: false });
        }
        if initial.is_empty() {
            // A structure without members has a position nevertheless, and many of them fill a memory.
            initial.push(0);
        }
        let structure = Structure { name: name.text.clone(), members, slots: initial.len() as u32 };
        Some(Shape { type_: Type::Struct(Arc::new(structure)), initial })
    }

    pub(super) fn limit_names(&mut self, what: &str, count: usize, span: Span) -> Option<()> {
        if count <= NAMES_MAX {
            return Some(());
        }
        self.refuse(Problem::new(span, format!("this type has {count} {what}, {NAMES_MAX} are the most")))
    }

    /// Refuses types that exceed any memory.
    pub(super) fn limit(&mut self, slots: usize, span: Span) -> Option<()> {
        if slots <= SLOTS_MAX as usize {
            return Some(());
        }
        let message = format!("this is larger than the {SLOTS_MAX} values that a program may have");
        self.refuse(Problem::new(span, message))
    }

    fn enumeration(
        &mut self,
        name: &Name,
        declared: &[(Name, Option<Expression>)],
        initial: Option<&Name>,
    ) -> Option<Shape> {
        self.limit_names("values", declared.len(), name.span)?;
        let mut values = Vec::<(String, i64)>::new();
        let mut next = 0_i128;
        for (value_name, number) in declared {
            if let Some(number) = number {
                next = self.constant_integer(number, &Scope::default())?;
            }
            if values.iter().any(|(other, _)| other.eq_ignore_ascii_case(&value_name.text)) {
                let message = format!("the enumeration has a value `{}` already", value_name.text);
                return self.refuse(Problem::new(value_name.span, message));
            }
            let Ok(value) = i32::try_from(next) else {
                let message = format!("{next} is not a DINT, the type of the values of an enumeration");
                return self.refuse(Problem::new(value_name.span, message));
            };
            values.push((value_name.text.clone(), value.into()));
            next += 1;
        }
        let first = match initial {
            Some(initial) => values.iter().find(|(value, _)| value.eq_ignore_ascii_case(&initial.text)),
            None => values.first(),
        };
        let Some(&(_, first)) = first else {
            let span = initial.map_or(name.span, |initial| initial.span);
            return self.refuse(Problem::new(span, format!("`{}` has no such value", name.text)));
        };
        let enumeration = Arc::new(Enumeration { name: name.text.clone(), values });
        for (value, number) in &enumeration.values {
            self.enum_values.entry(key(value)).or_default().push((enumeration.clone(), *number));
        }
        Some(Shape { type_: Type::Enum(enumeration), initial: vec![first as u64] })
    }

    /// A whole number that is known before the program runs.
    pub(super) fn constant_integer(&mut self, expression: &Expression, scope: &Scope) -> Option<i128> {
        Constants::new(self, scope).integer(expression)
    }
}

impl Shape {
    pub(super) fn zero(type_: Type) -> Self {
        let initial = vec![0; type_.slots() as usize];
        Self { type_, initial }
    }
}

const fn is_enumeration(declaration: &TypeDeclaration) -> bool {
    matches!(declaration.definition, TypeDefinition::Enum { .. })
}
