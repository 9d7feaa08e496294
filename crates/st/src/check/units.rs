//! The bodies of the program organization units.

use super::expressions::Body;
use super::{Checker, Pending, Purpose};
use crate::code::Unit;
use crate::problem::{Problem, Span};
use crate::syntax::ast::{File, Pou, PouKind};

impl<'t> Checker<'t> {
    /// Checks all of them, including those that are never called.
    pub(super) fn units(&mut self, file: &'t File) {
        self.programs(file);
        for pou in &file.units {
            match pou.kind {
                PouKind::Program => {}
                PouKind::FunctionBlock if self.is_named(pou) => {
                    self.named_shape(&pou.name.text, pou.name.span);
                }
                PouKind::FunctionBlock => {}
                PouKind::Function => self.uncalled_function(pou),
            }
        }
        // A body may be the first to use a block or a function, which also has a body.
        while let Some(pending) = self.pending.pop() {
            self.body(&pending);
        }
    }

    /// Refuses a file that is correct but has no PROGRAM, or is empty.
    pub(super) fn refuse_lack(&mut self, file: &File, purpose: Purpose) {
        let has_program = file.units.iter().any(|pou| pou.kind == PouKind::Program);
        let is_empty = file.units.is_empty() && file.types.is_empty() && file.globals.is_empty();
        let lacks = match purpose {
            Purpose::Run if !has_program => "there is no PROGRAM in it",
            Purpose::Judge if is_empty => "it is empty",
            _ => return,
        };
        if self.problems.is_empty() {
            let problem = Problem::new(Span::default(), lacks);
            self.refuse::<()>(problem.help("write PROGRAM name … END_PROGRAM, or statements alone"));
        }
    }

    /// Whether the name of the unit could be added.
    fn is_named(&self, pou: &Pou) -> bool {
        self.named.contains_key(&super::scope::key(&pou.name.text))
    }

    fn uncalled_function(&mut self, pou: &'t Pou) {
        let key = super::scope::key(&pou.name.text);
        if let Some(super::Named::Function(own)) = self.named.get(&key) {
            let own = *own;
            self.named.insert(key.clone(), super::Named::Wrong);
            if let Some(signature) = self.signature(own) {
                self.named.insert(key, super::Named::Signature(signature));
            }
        }
    }

    fn body(&mut self, pending: &Pending<'t>) {
        self.origin = pending.origin;
        let mut body = Body::new(self, &pending.scope, Some(pending.unit));
        let statements = body.statements(&pending.pou.body);
        let deepest = body.deepest;
        self.own_depths.insert(pending.unit, deepest);
        let fresh = pending.scope.fresh.clone();
        let is_library = pending.origin == super::Origin::Library;
        self.out.units[pending.unit as usize] = Unit { body: statements, fresh, is_library };
        self.origin = super::Origin::User;
    }
}
