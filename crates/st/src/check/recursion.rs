//! No program organization unit calls itself (IEC 61131-3, 6.6.1), and no code is nested too deeply.

use super::Checker;
use crate::problem::{Problem, Span};

/// Maximum nesting depth of statements, expressions and calls, counted from the PROGRAM: the stack of a thread
/// is sufficient for this.
const DEPTH_MAX: u32 = 1_000;

/// A call takes as much of the stack as this number of additional levels: its arguments are there.
const CALL_LEVELS: u32 = 3;

impl Checker<'_> {
    /// Refuses calls that return to their own unit, and those that are nested too deeply.
    pub(super) fn refuse_recursion(&mut self) {
        let units = self.out.units.len();
        let mut graph = Graph { callees: vec![Vec::new(); units], depths: vec![Depth::Unknown; units] };
        for (caller, callee, span) in core::mem::take(&mut self.calls) {
            graph.callees[caller as usize].push((callee, span));
        }
        for unit in 0..units {
            self.depth(unit, Span::default(), 0, &mut graph);
        }
    }

    /// Nesting depth of the code of a unit including all its calls; `level` calls have led here.
    fn depth(&mut self, unit: usize, span: Span, level: u32, graph: &mut Graph) -> u32 {
        match graph.depths[unit] {
            Depth::Known(depth) => return depth,
            Depth::InProgress => {
                let problem = Problem::new(span, "this call is recursive");
                self.refuse::<()>(problem.help("no function or block calls itself: use a loop"));
                return 0;
            }
            // Each call is at least one level, so the limit below has been exceeded.
            Depth::Unknown if level > DEPTH_MAX => return DEPTH_MAX,
            Depth::Unknown => {}
        }
        graph.depths[unit] = Depth::InProgress;
        let own = self.own_depths.get(&(unit as u32)).copied().unwrap_or(0);
        let mut deepest = own;
        for (callee, span) in core::mem::take(&mut graph.callees[unit]) {
            let depth = own + CALL_LEVELS + self.depth(callee as usize, span, level + 1, graph);
            if depth > DEPTH_MAX && deepest <= DEPTH_MAX {
                let message =
                    format!("statements, expressions and calls are nested more than {DEPTH_MAX} levels deep");
                self.refuse::<()>(Problem::new(span, message));
            }
            deepest = deepest.max(depth);
        }
        graph.depths[unit] = Depth::Known(deepest);
        deepest
    }
}

/// Callers and called units, by their numbers.
struct Graph {
    callees: Vec<Vec<(u32, Span)>>,
    depths: Vec<Depth>,
}

#[derive(Clone, Copy)]
enum Depth {
    Unknown,
    InProgress,
    Known(u32),
}
