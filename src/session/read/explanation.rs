//! The present numbers in the texts of the glossary, and the equation of motion with them.

use std::f64::consts::TAU;

use crate::branch::escape::leading_escape;
use crate::closed_form::{LinearFlow, fold, large_asymptote, lyapunov, small_asymptote};
use crate::model::{Knob, Parameters};
use crate::session::{Row, Session};
use crate::words::{exact, in_unit, joined};

/// Columns of a number; one that follows from others is rounded to them.
const COLUMNS: usize = 8;

impl Session {
    /// A formula with the present numbers in place of their names in braces; of its parts in brackets those whose
    /// numbers are all known.
    pub fn with_numbers(&self, formula: &str) -> String {
        let piece = |(place, piece): (usize, &str)| match place % 2 {
            0 => Some(piece.to_owned()),
            _ => self.number_of(piece),
        };
        let filled =
            |part: &str| part.split(['{', '}']).enumerate().map(piece).collect::<Option<String>>();
        joined(formula.split(['[', ']']).filter_map(filled), "")
    }

    /// A number by its name in formulas: of the parameter pane, or what follows.
    fn number_of(&self, name: &str) -> Option<String> {
        let named = |row: &Row| row.name_in(&self.problem) == name;
        if let Some(knob) = self.rows().into_iter().find(named).and_then(Row::stepped) {
            return Some(in_unit(&exact(self.value(knob), COLUMNS), knob.spec().unit));
        }
        self.following(name).map(|number| exact(number, COLUMNS))
    }

    /// A number that follows from the parameters, by a formula or because it is computed anyway.
    fn following(&self, name: &str) -> Option<f64> {
        let it = &self.problem.parameters;
        // Those of a machine stand in its units on the screen.
        let found = self.cycles().filter(|found| found.parameters == *it && it.r > 0.0);
        let found = found.filter(|_| self.running().is_none());
        match name {
            "2D" => Some(2.0 * it.d),
            "T0" => Some(2.0 * LinearFlow::new(it.d).half_period()?),
            "l" => lyapunov::radius(it).filter(|_| it.r > 0.0),
            "D_F1" => Some(fold(it.d3, it.r)?.d),
            "A_1" => small_asymptote(it),
            "A_2" => large_asymptote(it),
            "D_c" => Some(leading_escape(it.d2, it.r)).filter(|it| *it < 0.0),
            "displacement" => found?.margin.displacement,
            "shift" => found?.margin.from_rest.displacement,
            "impulse" => found?.margin.from_rest.impulse,
            "f0" => Some(self.units()?.omega_0 / TAU),
            _ => None,
        }
    }

    /// The equation of motion: with the present numbers, or of a machine that is shown by its whole model in its symbols.
    pub fn equation(&self) -> String {
        let Parameters { d, d2, d3, r } = self.problem.parameters;
        if self.draws_whole() {
            let whole = "m x'' + d1 x' + d3 x'^3 + c x = F [mu(v0 - x') - mu(v0)] + f_R";
            let terms = [(Knob::Damping, " + d1 x'"), (Knob::CubicDamping, " + d3 x'^3")];
            let terms = terms.into_iter().chain([(Knob::Friction, " + f_R")]);
            let none = terms.filter(|(knob, _)| self.value(*knob) == 0.0);
            return none.fold(whole.to_owned(), |text, (_, term)| text.replace(term, ""));
        }
        let damping = [(2.0 * d, "q'"), (d2, "q'^2"), (d3, "q'^3")];
        let terms = damping.into_iter().filter(|(size, _)| *size != 0.0).map(|(size, of)| {
            let sign = if size < 0.0 { '-' } else { '+' };
            format!(" {sign} {} {of}", exact(size.abs(), COLUMNS)).replace(" 1 q", " q")
        });
        let friction = Some(format!("in f_R, r = {}", exact(r, COLUMNS))).filter(|_| r > 0.0);
        let friction = friction.unwrap_or("= 0".to_owned());
        format!("q''{} + q {friction}", joined(terms, ""))
    }
}
