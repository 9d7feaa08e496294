//! No program organization unit calls itself (IEC 61131-3, 6.6.1), and none calls too deeply.

use super::Checker;
use crate::problem::{Problem, Span};

/// How deep calls may go: the stack of a thread holds that.
const DEPTH_MAX: u32 = 16;

impl Checker<'_> {
    /// Refuses calls that come back to where they began.
    pub(super) fn refuse_recursion(&mut self) {
        let mut depths = vec![Depth::Unknown; self.out.units.len()];
        for unit in 0..depths.len() {
            self.depth(unit as u32, Span::default(), &mut depths);
        }
    }

    fn depth(&mut self, unit: u32, span: Span, depths: &mut [Depth]) -> u32 {
        match depths[unit as usize] {
            Depth::Known(depth) => return depth,
            Depth::InProgress => {
                let problem = Problem::new(span, "this call comes back to itself");
                self.refuse::<()>(problem.help("no function or block calls itself: use a loop"));
                return 0;
            }
            Depth::Unknown => {}
        }
        depths[unit as usize] = Depth::InProgress;
        let callees = self.calls.iter().filter(|(caller, _, _)| *caller == unit);
        let callees = callees.map(|(_, callee, span)| (*callee, *span)).collect::<Vec<_>>();
        let mut deepest = 0;
        for (callee, span) in callees {
            let depth = self.depth(callee, span, depths) + 1;
            if depth == DEPTH_MAX {
                let message = format!("calls are nested deeper than {DEPTH_MAX}");
                self.refuse::<()>(Problem::new(span, message));
            }
            deepest = deepest.max(depth);
        }
        depths[unit as usize] = Depth::Known(deepest);
        deepest
    }
}

#[derive(Clone, Copy)]
enum Depth {
    Unknown,
    InProgress,
    Known(u32),
}
