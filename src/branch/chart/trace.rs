//! Drawing the lines of a chart: the boundaries on each, the bands between them, and further lines where a
//! boundary is bent.

use crate::branch::{
    FoldPlace, LOST, Regime, escape_point, escape_product, fold_near, fold_within,
};
use crate::closed_form::harmonic;
use crate::flow::{Cost, Limits, Reason, Result};
use crate::model::{Knob, Parameters};
use crate::numerics::{PlaceTolerance, exp, hypot, illinois, ln, powi, real};
use crate::portrait::cycles;

/// Maximum number of halvings between two lines, to come close to a boundary.
pub(crate) const HALVINGS: u32 = 8;

/// Relative error of a boundary that is sought, in units of that of the clearance at a fold.
const SLACK: f64 = 100.0;

/// Values of a parameter at which lines are drawn: evenly spaced, and denser towards zero, where a sign
/// changes; zero itself is replaced by its two sides.
pub(crate) fn values(symbol: Knob, range: (f64, f64), count: usize) -> Vec<f64> {
    /// What stands for zero, as a fraction of the range.
    const SIDE: f64 = 1e-6;
    let span = range.1 - range.0;
    let part = |index: usize, of: usize| real(index) / real(of);
    let mut values: Vec<f64> =
        (0..=count).map(|index| range.0 + span * part(index, count)).collect();
    if range.0 <= 0.0 && range.1 >= 0.0 {
        let dense = count / 4;
        for index in 1..dense {
            let cube = powi(part(index, dense), 3);
            values.extend([range.0, range.1].map(|end| 0.5 * end * cube));
        }
        values.extend([-SIDE * span, SIDE * span]);
        values.retain(|value| value.abs() >= SIDE * span);
    }
    values.retain(|&value| value >= range.0 && value <= range.1 && symbol.check(value).is_ok());
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

/// What a chart is drawn over: two different ones of D, D2, D3, r, and their ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The parameter to the right.
    pub right: Knob,
    /// The parameter upwards.
    pub up: Knob,
    pub right_range: (f64, f64),
    /// Range of the one upwards.
    pub up_range: (f64, f64),
}

impl Plane {
    /// The parameter along which lines run: D where it is one of the two, else the one that moves a fold
    /// from everywhere to everywhere.
    pub fn along(&self) -> Knob {
        let has = |symbol: Knob| self.right == symbol || self.up == symbol;
        [Knob::D, Knob::R, Knob::D3].into_iter().find(|&symbol| has(symbol)).unwrap_or(self.up)
    }

    /// The other parameter, at a value of which each line stands.
    pub fn across(&self) -> Knob {
        if self.along() == self.right {
            self.up
        } else {
            self.right
        }
    }

    pub fn range(&self, symbol: Knob) -> (f64, f64) {
        if symbol == self.right {
            self.right_range
        } else {
            self.up_range
        }
    }
}

/// How finely a chart is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Resolution {
    /// Lines that it has in any case, about.
    pub lines: usize,
    /// Largest distance between a boundary and its chord from line to line, as a fraction of the range; where
    /// it is more, further lines are drawn between. Infinite: none are.
    pub chord: f64,
    /// Relative error of the clearance at a fold; that of the boundaries is at most a hundred times this.
    pub tolerance: f64,
}

/// Draws lines one after the other; each helps to find the fold on the next.
pub(crate) struct Tracer<'a> {
    pub parameters: Parameters,
    pub plane: Plane,
    pub resolution: Resolution,
    pub limits: &'a Limits<'a>,
    /// Those that are drawn, by their values.
    pub lines: Vec<ChartLine>,
    pub cost: Cost,
    /// The fold in units of the harmonic one, on the line before.
    pub ratio: f64,
    /// The fold found last.
    pub known: Option<FoldPlace>,
}

impl Tracer<'_> {
    /// Adds the lines that are needed between two, so that chords lie close to the boundaries.
    pub fn between(&mut self, before: &ChartLine, after: &ChartLine, depth: u32) -> Result<()> {
        let chord = self.resolution.chord;
        let through_zero = before.at < 0.0 && after.at > 0.0;
        let failed = before.failure.is_some() || after.failure.is_some();
        if depth == 0 || chord.is_infinite() || through_zero || failed {
            return Ok(());
        }
        let middle = self.line(f64::midpoint(before.at, after.at))?;
        let [width, height] = [self.plane.along(), self.plane.across()].map(|knob| {
            let (from, to) = self.plane.range(knob);
            to - from
        });
        let boundary = |line: &ChartLine| line.fold.or(line.escape);
        let bent = match [before, &middle, after].map(boundary) {
            [Some(from), Some(middle), Some(to)] => {
                let slope = (to - from) / width / ((after.at - before.at) / height);
                (middle - f64::midpoint(from, to)).abs() / width > chord * hypot(1.0, slope)
            }
            _ => false,
        };
        if bent || !before.alike(after) {
            self.between(before, &middle, depth - 1)?;
            self.lines.push(middle.clone());
            self.between(&middle, after, depth - 1)?;
        }
        Ok(())
    }

    /// The line at this value of the other parameter.
    pub fn line(&mut self, at: f64) -> Result<ChartLine> {
        let here = self.parameters.with(self.plane.across(), at);
        let harmonic = self.harmonic(&here);
        let boundary = if self.plane.along() == Knob::D {
            self.boundary_in_d(&here)
        } else {
            self.boundary_at_d(&here)
        };
        let found = Reason::tolerated(boundary)?;
        let (boundary, failure) = (found.unwrap_or_default(), found.err());
        let bands = self.bands(&here, boundary, failure.is_some());
        let boundary = boundary.filter(|boundary| boundary.is_finite());
        if let (Some(fold), Some(harmonic)) = (boundary, harmonic)
            && fold != 0.0
        {
            self.ratio = fold / harmonic;
        }
        let folds = self.plane.along() == Knob::D3 || here.d3 > 0.0;
        let [fold, escape] = [folds, !folds].map(|it| boundary.filter(|_| it));
        Ok(ChartLine { at, bands, fold, harmonic, escape, failure })
    }

    /// The fold next to a guess, while `symbol` varies.
    fn fold_near(&mut self, guess: &FoldPlace, symbol: Knob) -> Result<Option<Parameters>> {
        let found = fold_near(guess, symbol, self.resolution.tolerance, self.limits)?;
        let found = self.cost.spend(found).map(|found| found.place);
        self.known = found.or(self.known);
        Ok(found.map(|found| found.parameters))
    }

    fn fold(&mut self, parameters: &Parameters) -> Result<f64> {
        let beside = self.known.and_then(|known| FoldPlace::beside(&known, parameters));
        if let Some(guess) = beside
            && let Some(found) = self.fold_near(&guess, Knob::D)?
        {
            return Ok(found.d);
        }
        let found = fold_within(parameters, self.resolution.tolerance, self.limits)?;
        self.cost.spend(found).map(|found| found.d).ok_or(LOST)
    }

    /// `D_F` or `D_c` on a line along D; minus infinity where it lies below everything that is asked for.
    fn boundary_in_d(&mut self, here: &Parameters) -> Result<Option<f64>> {
        /// Beyond critical damping folds take long; whether the range has any can be asked at its end.
        const CRITICAL: f64 = -1.0 + 1e-6;
        const DOUBTFUL: f64 = -0.75;
        if here.r == 0.0 || here.d3 < 0.0 {
            return Ok(None);
        }
        if here.d3 == 0.0 {
            let escape = self.cost.spend(escape_point(here, self.limits)?);
            return Ok(escape.or(Some(f64::NEG_INFINITY)));
        }
        let strong = harmonic::fold(here.d3, here.r).is_none_or(|fold| fold.d < DOUBTFUL)
            || here.r * here.d2.abs() > -DOUBTFUL;
        let least = self.plane.range(Knob::D).0;
        if strong && least >= -1.0 {
            let end = Parameters { d: least.max(CRITICAL), ..*here };
            let found = cycles(&end, self.limits)?;
            self.cost += found.cost;
            if found.cycles.is_empty() {
                return Ok(Some(f64::NEG_INFINITY));
            }
        }
        Ok(Some(self.fold(here)?))
    }

    /// Where on a line along D3 or r the fold or the escape point comes to the given D.
    fn boundary_at_d(&mut self, here: &Parameters) -> Result<Option<f64>> {
        let Parameters { d, d2, d3, r } = *here;
        if d >= 0.0 {
            return Ok(None);
        }
        if self.plane.along() == Knob::D3 {
            if r == 0.0 {
                return Ok(None);
            }
            // As D3 goes to 0 the fold goes to D_c: if that lies below D, so do all folds.
            let without = Parameters { d3: 0.0, ..*here };
            let least = self.cost.spend(escape_point(&without, self.limits)?);
            let none = d2 != 0.0 && least.is_none_or(|least| d >= least);
            return if none { Ok(Some(0.0)) } else { self.seek(here) };
        }
        if d3 > 0.0 {
            return self.seek(here);
        }
        if d3 == 0.0 && d2 != 0.0 && d > -1.0 {
            // D_c depends on r D2 alone.
            let product = self.cost.spend(escape_product(d, self.limits)?);
            let lost = Reason::NoConvergence { sought: "the escape point", change: f64::NAN };
            return Ok(Some(product.ok_or(lost)? / d2.abs()));
        }
        Ok(None)
    }

    /// The value along the line at which the fold is at the line's D; infinite where none is.
    fn seek(&mut self, here: &Parameters) -> Result<Option<f64>> {
        let Some(guess) = self.harmonic(here) else { return Ok(None) };
        let (guess, along) = (guess * self.ratio, self.plane.along());
        let near = here.with(along, guess);
        let beside = match &self.known {
            Some(known) => FoldPlace::beside(known, &near),
            None => FoldPlace::in_damping(&near),
        };
        if let Some(beside) = beside
            && let Some(found) = self.fold_near(&FoldPlace { parameters: near, ..beside }, along)?
        {
            return Ok(Some(found.value(along)));
        }
        let place = root(ln(guess), SLACK * self.resolution.tolerance, |z| {
            let found = self.fold(&here.with(along, exp(z)))?;
            Ok(ln(found / here.d))
        });
        place.map(|z| Some(exp(z)))
    }

    /// The fold of one harmonic (48) on the line.
    fn harmonic(&self, here: &Parameters) -> Option<f64> {
        let Parameters { d, d3, r, .. } = *here;
        if self.plane.along() == Knob::D {
            return harmonic::fold(d3, r).map(|fold| fold.d);
        }
        // (48) solved for r^2 D3.
        let product = 8.0 * powi(-d, 3) * powi(std::f64::consts::PI / 9.0, 2);
        let value = match self.plane.along() {
            Knob::D3 => product / (r * r),
            _ => (product / d3).sqrt(),
        };
        (d < 0.0 && value.is_finite() && value > 0.0).then_some(value)
    }

    /// The bands on both sides of the boundary within the range.
    fn bands(&self, here: &Parameters, boundary: Option<f64>, failed: bool) -> Vec<Band> {
        let along = self.plane.along();
        let (from, to) = self.plane.range(along);
        let inside = |value: &f64| *value > from && *value < to;
        let critical = (along == Knob::D).then_some(-1.0);
        let places = [0.0].into_iter().chain(critical).chain(boundary).filter(inside);
        let mut ends: Vec<f64> = places.chain([from, to]).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let regime = |value: f64| {
            let parameters = here.with(along, value);
            let Parameters { d, d3, r, .. } = parameters;
            if failed && d < 0.0 && d3 >= 0.0 && r > 0.0 {
                return None;
            }
            if along == Knob::D {
                return Some(Regime::of(&parameters, boundary));
            }
            // A line that crosses the boundary at the given D lies below it in D before it.
            let beyond = boundary.is_some_and(|boundary| value >= boundary);
            Some(Regime::of(&parameters, Some(if beyond { f64::NEG_INFINITY } else { 0.0 })))
        };
        let mut bands: Vec<Band> = Vec::new();
        for pair in ends.windows(2) {
            let regime = regime(0.5 * (pair[0] + pair[1]));
            match bands.last_mut() {
                Some(last) if last.regime == regime => last.to = pair[1],
                _ => bands.push(Band { from: pair[0], to: pair[1], regime }),
            }
        }
        bands
    }
}

/// Where an increasing function is at most `small`, near `start`: strides until its zero lies between,
/// then the Illinois rule.
fn root(start: f64, small: f64, mut function: impl FnMut(f64) -> Result<f64>) -> Result<f64> {
    /// First stride in the logarithm: the guess is better than this on all lines but the first.
    const STRIDE: f64 = 0.1;
    const MOST: usize = 60;
    let mut low = (start, function(start)?);
    let (mut high, mut stride, mut steps) = (low, STRIDE, 0);
    while low.1 > 0.0 || high.1 < 0.0 {
        if low.1 > 0.0 {
            high = low;
            low.0 -= stride;
            low.1 = function(low.0)?;
        } else {
            low = high;
            high.0 += stride;
            high.1 = function(high.0)?;
        }
        stride *= 1.6;
        steps += 1;
        if steps > MOST {
            return Err(Reason::NoConvergence { sought: "a boundary", change: stride });
        }
    }
    let [best, other] = illinois([low, high], small, PlaceTolerance::Absolute(small), function)?;
    if best.1.abs() <= small || (other.0 - best.0).abs() <= small {
        return Ok(best.0);
    }
    Err(Reason::NoConvergence { sought: "a boundary", change: (other.0 - best.0).abs() })
}

/// A part of a line in which one regime holds; `None` where it could not be found out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// What holds there.
    pub regime: Option<Regime>,
}

/// The bands at one value of the other parameter, and the boundaries between them.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartLine {
    /// Value of the other parameter.
    pub at: f64,
    /// From one end of the range to the other.
    pub bands: Vec<Band>,
    /// The fold, also where it lies outside of the range.
    pub fold: Option<f64>,
    /// The fold by one harmonic (48).
    pub harmonic: Option<f64>,
    /// The escape point.
    pub escape: Option<f64>,
    /// Why the boundaries could not be computed.
    pub failure: Option<Reason>,
}
