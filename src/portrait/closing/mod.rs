//! Pairs of half swings that close: the limit cycles of what has no belt.
//!
//! Everything rests on the half-swing map ([`half_map`]), which contains no friction, is increasing, and is inverted by
//! itself with the damping reversed. Cycles close two of them ([`equation`]); a search that excludes what cannot hold
//! a cycle finds all ([`search`], [`all`]), and energy decides where differences lose their digits ([`balance`]).

pub mod all;
pub(crate) mod balance;
pub mod equation;
pub mod half_map;
pub(crate) mod pair;
pub mod polish;
pub(crate) mod precise;
pub(crate) mod return_map;
mod roundoff;
pub(crate) mod search;
pub(crate) mod weak;

pub(crate) use self::{
    all::*, balance::*, equation::*, half_map::*, pair::*, polish::*, precise::*, roundoff::*,
    search::*, weak::*,
};
