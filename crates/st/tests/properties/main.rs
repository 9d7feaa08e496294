//! Properties of the language, compared with separate evaluators that share no code with the crate: types,
//! expressions, conversions, statements.

#![expect(clippy::expect_used, reason = "a panic here is a failed test")]

mod assignments;
mod conversions;
mod expression;
mod expressions;
mod generator;
mod interpreter;
mod statement;
mod statements;
mod tape;
mod types;
mod values;
