//! VAR sections: the positions of variables, and the meaning of their names.

use super::scope::{Access, Located, Scope, Symbol, key};
use super::unknown_names::{nearest_port, remedy, remedy_of_a_device};
use super::{Checker, Origin, Pending, Shape, Signature};
use crate::code::Base;
use crate::layout::Layout;
use crate::memory::Slot;
use crate::problem::{Problem, Span};
use crate::syntax::ast::{File, Name, Pou, TypeKind, VarDeclaration, VarKind, VarSection};
use crate::system::System;
use crate::types::{Block, Member, Role, Type};
use crate::variable::{External, Owner, Variable};
use std::rc::Rc;
use std::sync::Arc;

/// Why a constant cannot be written.
const CONSTANT: &str = "it is a constant";
/// Why an input of the unit that is being called cannot be written.
const OWN_INPUT: &str = "it is an input";

/// The positions of the variables of a unit.
enum Home {
    /// In the memory: PROGRAM, and VAR_GLOBAL without an owner.
    Memory { owner: Option<Owner> },
    /// In the memory, with their initial values at each call: FUNCTION.
    Fresh,
    /// In the instances of a function block.
    Instance,
}

/// The result of a VAR section.
struct Plan {
    home: Home,
    members: Vec<Member>,
    initial: Vec<u64>,
}

impl<'t> Checker<'t> {
    /// VAR_GLOBAL of the file, in an order in which each finds what it needs: constants are bounds of types and
    /// numbers of enumerations, and blocks may use all other variables as VAR_EXTERNAL.
    pub(super) fn declare_globals(&mut self, file: &'t File) {
        let all = || {
            file.globals.iter().flat_map(|section| section.variables.iter().map(move |own| (section, own)))
        };
        let is_number = |section: &VarSection, own: &VarDeclaration| {
            section.constant && matches!(own.type_name.kind, TypeKind::Elementary(_))
        };
        for (section, own) in all().filter(|(section, own)| is_number(section, own)) {
            self.declare_global(section, own);
        }
        self.resolve_enumerations(file);
        let (blocks, others): (Vec<_>, Vec<_>) = all()
            .filter(|(section, own)| !is_number(section, own))
            .partition(|(_, own)| self.is_of_blocks(&own.type_name.kind, 0));
        for (section, own) in others.into_iter().chain(blocks) {
            self.declare_global(section, own);
        }
    }

    fn declare_global(&mut self, section: &VarSection, declaration: &VarDeclaration) {
        if self.globals.contains_key(&key(&declaration.name.text)) {
            return self.refuse_second_global(&declaration.name);
        }
        let mut scope = Scope::default();
        let mut plan = Plan::new(Home::Memory { owner: None });
        self.declare(section, declaration, &mut plan, &mut scope);
        self.refuse_without_a_device(declaration);
        self.globals.extend(scope.symbols);
        self.first_places.insert(key(&declaration.name.text), declaration.name.span);
    }

    /// Refuses a global variable that has the name of a device variable which the unit does not have: nothing
    /// would exchange it.
    fn refuse_without_a_device(&mut self, declaration: &VarDeclaration) {
        let name = &declaration.name;
        let globals = self.surroundings.globals;
        if declaration.at.is_some() || globals.iter().any(|own| own.name.eq_ignore_ascii_case(&name.text)) {
            return;
        }
        if let Some(remedy) = remedy_of_a_device(&name.text, globals) {
            let message = format!("the unit has no device variable `{}`, so nothing exchanges it", name.text);
            self.refuse::<()>(Problem::new(name.span, message).help(remedy));
        }
    }

    pub(super) fn refuse_second(&mut self, name: &Name) {
        let message = format!("the name `{}` is declared twice", name.text);
        self.refuse::<()>(Problem::new(name.span, message));
    }

    /// The same for a name of the whole program, whose first declaration may be in another file.
    fn refuse_second_global(&mut self, name: &Name) {
        let message = format!("the name `{}` is declared twice", name.text);
        let problem = Problem::new(name.span, message);
        let first = self.first_places.get(&key(&name.text)).copied();
        self.refuse::<()>(Problem { first, ..problem });
    }

    /// The variables of a PROGRAM that runs under this name.
    pub(super) fn program_scope(&mut self, pou: &Pou, name: &str) -> Scope {
        let mut scope = Scope::default();
        let owner = Some(Owner { name: name.to_owned(), program: pou.name.text.clone() });
        let mut plan = Plan::new(Home::Memory { owner });
        for section in &pou.sections {
            self.section(section, &mut plan, &mut scope);
        }
        scope
    }

    /// A function block type, whose body is to be checked later.
    pub(super) fn block_shape(&mut self, pou: &'t Pou, origin: Origin) -> Option<Shape> {
        let unit = self.new_unit();
        let outer = core::mem::replace(&mut self.origin, origin);
        let mut scope = Scope::default();
        let mut plan = Plan::new(Home::Instance);
        for section in &pou.sections {
            self.section(section, &mut plan, &mut scope);
        }
        self.origin = outer;
        self.limit_names("variables", plan.members.len(), pou.name.span)?;
        if plan.initial.is_empty() {
            // An instance without variables has a position nevertheless.
            plan.initial.push(0);
        }
        let slots = plan.initial.len() as u32;
        let block = Block { name: pou.name.text.clone(), unit, members: plan.members, slots };
        self.pending.push(Pending { pou, unit, scope, origin });
        Some(Shape { type_: Type::Block(Arc::new(block)), initial: plan.initial })
    }

    /// A function as its callers see it; its body is to be checked later.
    pub(super) fn signature(&mut self, pou: &'t Pou) -> Option<Rc<Signature>> {
        let unit = self.new_unit();
        let mut scope = Scope::default();
        let mut plan = Plan::new(Home::Fresh);
        for section in &pou.sections {
            self.section(section, &mut plan, &mut scope);
        }
        let result = match &pou.result {
            Some(type_name) => {
                if scope.symbols.contains_key(&key(&pou.name.text)) {
                    // The result is a variable of this name.
                    self.refuse_second(&pou.name);
                }
                let shape = self.shape(type_name, &scope)?;
                self.refuse_block(&shape.type_, type_name.span)?;
                let slot = self.place_fresh(&shape, type_name.span, &mut scope)?;
                let located = Located::in_memory(slot, shape.type_.clone(), Access::Write);
                scope.symbols.insert(key(&pou.name.text), Symbol::Variable(located));
                Some((slot, shape.type_))
            }
            None => None,
        };
        self.pending.push(Pending { pou, unit, scope, origin: Origin::User });
        let pins = plan.members.into_iter().filter(|member| member.role != Role::Internal).collect();
        Some(Rc::new(Signature { name: pou.name.text.clone(), unit, pins, result }))
    }

    fn refuse_block(&mut self, type_: &Type, span: Span) -> Option<()> {
        if !type_.holds_blocks() {
            return Some(());
        }
        self.refuse(
            Problem::new(span, "a function has no function block instances")
                .help("a function keeps no values between calls: use a FUNCTION_BLOCK"),
        )
    }

    fn section(&mut self, section: &VarSection, plan: &mut Plan, scope: &mut Scope) {
        self.refuse_misplaced(section, &plan.home);
        for declaration in &section.variables {
            self.declare(section, declaration, plan, scope);
        }
    }

    fn refuse_misplaced(&mut self, section: &VarSection, home: &Home) {
        let message = match (section.kind, home) {
            (VarKind::Input | VarKind::Output | VarKind::InOut, Home::Memory { .. }) => {
                "a PROGRAM cannot have inputs and outputs"
            }
            (VarKind::Global, Home::Fresh | Home::Instance) => {
                "VAR_GLOBAL is permitted only outside functions and blocks"
            }
            _ => return,
        };
        self.refuse::<()>(Problem::new(section.span, message).help("use VAR or VAR_EXTERNAL"));
    }

    fn declare(
        &mut self,
        section: &VarSection,
        declaration: &VarDeclaration,
        plan: &mut Plan,
        scope: &mut Scope,
    ) -> Option<()> {
        if self.is_given_up() {
            return None;
        }
        if scope.symbols.contains_key(&key(&declaration.name.text)) {
            self.refuse_second(&declaration.name);
            return None;
        }
        let symbol = self.symbol(section, declaration, plan, scope).unwrap_or(Symbol::Wrong);
        scope.symbols.insert(key(&declaration.name.text), symbol);
        Some(())
    }

    fn symbol(
        &mut self,
        section: &VarSection,
        declaration: &VarDeclaration,
        plan: &mut Plan,
        scope: &mut Scope,
    ) -> Option<Symbol> {
        let shape = match section.kind {
            VarKind::InOut => self.in_out_shape(&declaration.type_name, scope)?,
            _ => self.shape(&declaration.type_name, scope)?,
        };
        if section.kind == VarKind::External
            || declaration.at.is_some()
            || self.is_device(section, declaration)
        {
            return self.external(declaration, &shape.type_);
        }
        if section.kind == VarKind::InOut {
            if let Some(initial) = &declaration.initial {
                let message = "a VAR_IN_OUT has no initial value: it is a variable of the caller's";
                return self.refuse(Problem::new(super::initials::span(initial), message));
            }
            return self.in_out(declaration, shape.type_, plan, scope);
        }
        let shape = self.with_initial(shape, declaration.initial.as_ref(), scope)?;
        if section.constant
            && role(section.kind) == Role::Internal
            && matches!(shape.type_, Type::Elementary(_) | Type::Enum(_))
        {
            return Some(Symbol::Constant(shape.type_, shape.initial[0]));
        }
        let access = if section.constant { Access::ReadOnly(CONSTANT) } else { Access::Write };
        self.variable(section, declaration, shape, access, plan, scope).map(Symbol::Variable)
    }

    fn variable(
        &mut self,
        section: &VarSection,
        declaration: &VarDeclaration,
        shape: Shape,
        access: Access,
        plan: &mut Plan,
        scope: &mut Scope,
    ) -> Option<Located> {
        let role = role(section.kind);
        let access = if role == Role::Input { Access::ReadOnly(OWN_INPUT) } else { access };
        let (name, span) = (&declaration.name, declaration.type_name.span);
        let type_ = shape.type_.clone();
        if section.kind == VarKind::Temp || matches!(plan.home, Home::Fresh) {
            self.refuse_block(&type_, span)?;
            let slot = self.place_fresh(&shape, span, scope)?;
            if matches!(plan.home, Home::Fresh) {
                let name = name.text.clone();
                plan.members.push(Member { name, type_: type_.clone(), offset: slot, role, retain: false });
            }
            return Some(Located::in_memory(slot, type_, access));
        }
        match &plan.home {
            Home::Memory { owner } => {
                let slot = self.allocate(&shape.initial, span)?;
                self.out.variables.push(Variable {
                    owner: owner.clone(),
                    name: name.text.clone(),
                    type_: type_.clone(),
                    slot,
                    retain: section.retain,
                });
                Some(Located::in_memory(slot, type_, access))
            }
            Home::Fresh | Home::Instance => {
                let offset = plan.initial.len() as u32;
                self.limit(plan.initial.len() + shape.initial.len(), span)?;
                plan.initial.extend_from_slice(&shape.initial);
                let (name, retain) = (name.text.clone(), section.retain);
                plan.members.push(Member { name, type_: type_.clone(), offset, role, retain });
                Some(Located::at(Base::Instance, offset, type_, access))
            }
        }
    }

    fn place_fresh(&mut self, shape: &Shape, span: Span, scope: &mut Scope) -> Option<Slot> {
        let slot = self.allocate(&shape.initial, span)?;
        scope.fresh.push(slot..slot + shape.initial.len() as u32);
        Some(slot)
    }

    /// A variable of the caller: a slot of the unit holds its position.
    fn in_out(
        &mut self,
        declaration: &VarDeclaration,
        type_: Type,
        plan: &mut Plan,
        scope: &mut Scope,
    ) -> Option<Symbol> {
        let slots = type_.reference_slots() as usize;
        let offset = match plan.home {
            Home::Fresh => {
                let slot = self.allocate(&vec![0; slots], declaration.name.span)?;
                scope.fresh.push(slot..slot + slots as u32);
                slot
            }
            _ => {
                plan.initial.extend(core::iter::repeat_n(0, slots));
                (plan.initial.len() - slots) as u32
            }
        };
        let name = declaration.name.text.clone();
        plan.members.push(Member { name, type_: type_.clone(), offset, role: Role::InOut, retain: false });
        let fresh = matches!(plan.home, Home::Fresh);
        let located = match (&type_, fresh) {
            (Type::Any, true) => Located::in_memory(offset, type_, Access::ReadOnly("it is a reference")),
            (Type::Any, false) => {
                Located::at(Base::Instance, offset, type_, Access::ReadOnly("it is a reference"))
            }
            (_, true) => Located::at(Base::ReferenceInMemory(offset), 0, type_, Access::Write),
            (_, false) => Located::at(Base::ReferenceInInstance(offset), 0, type_, Access::Write),
        };
        Some(Symbol::Variable(located))
    }

    /// A global variable with the name of a device variable is that device variable, as in a list of global variables.
    fn is_device(&self, section: &VarSection, declaration: &VarDeclaration) -> bool {
        let name = &declaration.name.text;
        section.kind == VarKind::Global
            && self.surroundings.globals.iter().any(|global| global.name.eq_ignore_ascii_case(name))
    }

    /// VAR_EXTERNAL, or a variable with AT: a device variable, or a VAR_GLOBAL of the file.
    fn external(&mut self, declaration: &VarDeclaration, type_: &Type) -> Option<Symbol> {
        let symbol = match &declaration.at {
            Some(at) => self.device_at(at)?,
            None => self.global_or_device(declaration)?,
        };
        let found = match &symbol {
            Symbol::Variable(located) => &located.type_,
            Symbol::Constant(type_, _) => type_,
            Symbol::Wrong => return None,
        };
        if found == type_ {
            return Some(symbol);
        }
        let message = format!("`{}` is {found}, not {type_}", declaration.name.text);
        self.refuse(Problem::new(declaration.type_name.span, message))
    }

    fn global_or_device(&mut self, declaration: &VarDeclaration) -> Option<Symbol> {
        let name = &declaration.name;
        if let Some(symbol) = self.globals.get(&key(&name.text)) {
            return Some(symbol.clone());
        }
        let given = self.device_named(&name.text).or_else(|| self.system_variable(&name.text));
        if given.is_some() {
            return given;
        }
        let own = self.globals.keys().cloned();
        let remedy = remedy(&name.text, own, self.surroundings.globals, "declare it in VAR_GLOBAL");
        let problem = Problem::new(name.span, format!("there is no global variable `{}`", name.text));
        self.refuse(problem.help(remedy))
    }

    fn device_at(&mut self, at: &crate::syntax::ast::Name) -> Option<Symbol> {
        let globals = self.surroundings.globals;
        let found = globals
            .iter()
            .position(|global| global.at.as_deref().is_some_and(|path| path.eq_ignore_ascii_case(&at.text)));
        if let Some(place) = found {
            return self.device(place);
        }
        let ports: Vec<_> = globals.iter().filter_map(|global| global.at.clone()).collect();
        let near = nearest_port(&at.text, &ports);
        let problem = Problem::new(at.span, format!("there is no I/O port `{}`", at.text));
        self.refuse(match near {
            Some(near) => problem.did_you_mean(near),
            None => problem.help("the I/O ports are those of the unit's I/O allocation"),
        })
    }

    /// The device variable of this name.
    pub(super) fn device_named(&mut self, name: &str) -> Option<Symbol> {
        let globals = self.surroundings.globals;
        let place = globals.iter().position(|global| global.name.eq_ignore_ascii_case(name))?;
        self.device(place)
    }

    /// Adds a device variable to the memory when it is first used.
    fn device(&mut self, place: usize) -> Option<Symbol> {
        if let Some(symbol) = self.devices.get(&place) {
            return Some(symbol.clone());
        }
        let surroundings = self.surroundings;
        let mut declarations = surroundings.declared.globals.iter().flat_map(|section| &section.variables);
        let declaration = declarations.nth(place)?;
        let shape = self.shape(&declaration.type_name, &Scope::default())?;
        let shape = self.with_initial(shape, declaration.initial.as_ref(), &Scope::default())?;
        let slot = self.allocate(&shape.initial, declaration.name.span)?;
        let global = &surroundings.globals[place];
        let access = match &global.constant {
            Some(_) => Access::ReadOnly(CONSTANT),
            None => self.refreshed(place, slot, &shape.type_)?,
        };
        self.out.variables.push(Variable {
            owner: None,
            name: global.name.clone(),
            type_: shape.type_.clone(),
            slot,
            retain: false,
        });
        let symbol = Symbol::Variable(Located::in_memory(slot, shape.type_, access));
        self.devices.insert(place, symbol.clone());
        Some(symbol)
    }

    /// The system-defined variable of this name.
    pub(super) fn system_variable(&mut self, name: &str) -> Option<Symbol> {
        let system = System::named(name)?;
        if let Some(value) = system.constant() {
            return Some(Symbol::Constant(Type::BOOL, value.into()));
        }
        let known = self.out.system.iter().find(|(own, _)| *own == system).map(|(_, slot)| *slot);
        let slot = match known {
            Some(slot) => slot,
            None => {
                let slot = self.allocate(&[0], Span::default())?;
                self.out.system.push((system, slot));
                slot
            }
        };
        let access =
            if system.is_writable() { Access::Write } else { Access::ReadOnly("the system writes it") };
        Some(Symbol::Variable(Located::in_memory(slot, Type::BOOL, access)))
    }

    /// Records a device variable that is refreshed before and after each scan.
    fn refreshed(&mut self, place: usize, slot: Slot, type_: &Type) -> Option<Access> {
        let layout = Layout { values: super::places::flatten(type_)? };
        self.out.externals.push(External { global: place, slot, layout, written: false });
        Some(match self.surroundings.globals[place].writable {
            true => Access::Device(self.out.externals.len() - 1),
            false => Access::ReadOnly("it comes from the unit"),
        })
    }
}

impl Plan {
    const fn new(home: Home) -> Self {
        Self { home, members: Vec::new(), initial: Vec::new() }
    }
}

const fn role(kind: VarKind) -> Role {
    match kind {
        VarKind::Input => Role::Input,
        VarKind::Output => Role::Output,
        VarKind::InOut => Role::InOut,
        _ => Role::Internal,
    }
}
