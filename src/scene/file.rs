//! Scene files: reads TOML into a [`Scene`], or reports the first mistake and its place in one line.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use toml::Spanned;

use super::machine::{self, ScaledMachine};
use super::misread::{self, Complaint, Misread};
use super::ordinate::{Ordinate, Unit};
use super::plot_setup::{Arrangement, Axes, MOST_PLOTS, PlotSetup};
use super::scene::{Scene, Variant};
use super::views::{Layer, View};
use super::window::{Span, Window};
use crate::flow::{Method, Problem};
use crate::model::{Knob, Parameters, State};
use crate::words::one_of;

/// The file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    title: String,
    also: Option<String>,
    look: String,
    press: String,
    terms: Option<BTreeSet<Knob>>,
    machine: Option<Spanned<String>>,
    /// Speed of the machine's belt in m/s, where it differs from the machine's own.
    belt: Option<Spanned<f64>>,
    #[serde(default)]
    values: BTreeMap<Knob, Spanned<f64>>,
    #[serde(default)]
    steps: BTreeMap<Knob, Spanned<f64>>,
    until: Option<Spanned<f64>>,
    #[serde(default = "auto")]
    method: Method,
    tolerance: Option<Spanned<f64>>,
    step: Option<Spanned<f64>>,
    epsilon: Option<Spanned<f64>>,
    layers: BTreeSet<Layer>,
    #[serde(default)]
    arrange: Arrangement,
    #[serde(default)]
    plot: Vec<Spanned<PlotTable>>,
}

/// A plot: its view, its axes, and the part to show.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlotTable {
    view: View,
    over: Option<Spanned<Knob>>,
    ordinate: Option<Spanned<Ordinate>>,
    unit: Option<Spanned<Unit>>,
    against: Option<Spanned<Knob>>,
    #[serde(default)]
    with: Vec<BTreeMap<Knob, Spanned<f64>>>,
    x: Option<Span>,
    y: Option<Span>,
}

fn auto() -> Method {
    Method::Auto
}

/// Reads a scene; `name` is the name by which it is opened, `file` the one in error messages. Fails with
/// [`Misread`], which names the place and what is allowed there.
pub fn parse(name: &str, file: &str, text: &str) -> Result<Scene, Misread> {
    let read: SceneFile = misread::toml(file, text)?;
    scene(name, read).map_err(|complaint| complaint.in_file(file, text))
}

fn scene(name: &str, read: SceneFile) -> Result<Scene, Complaint> {
    let scaled = read.machine.as_ref().map(|name| scaled(name, read.belt.as_ref())).transpose()?;
    let terms = match (&read.terms, &scaled) {
        (Some(terms), None) => terms.clone(),
        (None, Some(scaled)) => scaled.terms(),
        (Some(_), Some(_)) => return Err(either("terms and a machine")),
        (None, None) => return Err(either("neither terms nor a machine")),
    };
    let own = match &scaled {
        Some(scaled) => of_machine(scaled, &read)?,
        None => of_values(&read, &terms)?,
    };
    let until = read.until.as_ref();
    let problem = Problem {
        until: until.map_or(Ok(own.until), |given| checked(Knob::Until, given))?,
        method: read.method,
        tolerance: within(Knob::Tolerance, read.tolerance.as_ref())?,
        step: within(Knob::Step, read.step.as_ref())?,
        epsilon: within(Knob::Epsilon, read.epsilon.as_ref())?,
        ..own
    };
    let mut families = Vec::new();
    let plot_setups = read.plot.iter().map(|plot| plot_setup(plot, &mut families));
    let plots = plot_setups.collect::<Result<Vec<_>, _>>()?;
    if plots.is_empty() || plots.len() > MOST_PLOTS {
        let at = read.plot.get(MOST_PLOTS).map_or(0..0, Spanned::span);
        let message = format!(
            "a scene has 1 to {MOST_PLOTS} plots, each as [[plot]]; this one has {}",
            plots.len()
        );
        return Err(Complaint { at, message });
    }
    Ok(Scene {
        name: name.to_owned(),
        also: read.also,
        title: read.title,
        watch: read.look,
        press: read.press,
        problem,
        steps: steps(&read.steps)?,
        terms,
        layers: read.layers,
        plots,
        families,
        arrangement: read.arrange,
        machine: scaled,
        recording: None,
    })
}

/// The complaint about a scene with both terms and a machine, or with neither.
fn either(given: &str) -> Complaint {
    let message =
        format!("a scene has {given}; it takes one of them: terms = [..] or machine = \"..\"");
    Complaint { at: 0..0, message }
}

/// The built-in machine with this name, with its belt at this speed.
fn scaled(
    name: &Spanned<String>,
    speed: Option<&Spanned<f64>>,
) -> Result<Box<ScaledMachine>, Complaint> {
    let complain = |message| Complaint { at: name.span(), message };
    let known = machine::library::machines().iter();
    let known = known.map(|machine| (machine.name.as_str(), machine));
    let machine = one_of("machine", name.get_ref(), known).map_err(complain)?;
    let mut machine = machine.clone();
    if let Some(speed) = speed {
        machine.belt.belt_speed = checked(Knob::BeltSpeed, speed)?;
    }
    ScaledMachine::new(machine).map(Box::new).map_err(|error| complain(error.to_string()))
}

/// The motion of a machine.
fn of_machine(scaled: &ScaledMachine, read: &SceneFile) -> Result<Problem, Complaint> {
    if let Some((symbol, given)) = read.values.iter().next() {
        let message = format!("{symbol} comes from the machine; leave its value out");
        return Err(Complaint { at: given.span(), message });
    }
    Ok(scaled.problem())
}

/// A plot of a scene. Axes may be given only where the view leaves a choice; a window needs both directions or
/// neither.
fn plot_setup(
    read: &Spanned<PlotTable>,
    families: &mut Vec<Vec<Variant>>,
) -> Result<PlotSetup, Complaint> {
    let PlotTable { view, over, ordinate, unit, against, with, x, y } = read.get_ref();
    let title = view.spec().title;
    let span = |given: &Option<Spanned<Knob>>| given.as_ref().map(Spanned::span);
    for (given, views) in [
        (span(over), &[View::Diagram, View::Regimes][..]),
        (ordinate.as_ref().map(Spanned::span), &[View::Diagram]),
        (unit.as_ref().map(Spanned::span), &[View::Diagram]),
        (span(against), &[View::Regimes]),
    ] {
        if let Some(at) = given.filter(|_| !views.contains(view)) {
            let message =
                format!("a view \"{}\" has no such axis; leave this out", view.spec().name);
            return Err(Complaint { at, message });
        }
    }
    let usual = Axes::default();
    let axes = Axes {
        abscissa: over.as_ref().map_or(usual.abscissa, |over| *over.get_ref()),
        ordinate: ordinate.as_ref().map_or(usual.ordinate, |ordinate| *ordinate.get_ref()),
        unit: unit.as_ref().map_or(usual.unit, |unit| *unit.get_ref()),
        against: against.as_ref().map_or(usual.against, |against| *against.get_ref()),
    };
    if let Some(unit) = unit.as_ref().filter(|_| axes.ordinate.spec().ratio.is_none()) {
        let message = format!("{} is not a length; leave its unit out", axes.ordinate.spec().name);
        return Err(Complaint { at: unit.span(), message });
    }
    for axis in [over, against].into_iter().flatten() {
        if !axis.get_ref().is_parameter() {
            let message =
                format!("no plot over {} exists; D, D2, D3 and r are allowed", axis.get_ref());
            return Err(Complaint { at: axis.span(), message });
        }
    }
    if *view == View::Regimes && axes.abscissa == axes.against {
        let at = span(against).or(span(over)).unwrap_or_else(|| read.span());
        let message = format!("a chart has two different axes; both are {}", axes.against);
        return Err(Complaint { at, message });
    }
    let window = match (*x, *y) {
        (Some(x), Some(y)) => Some(Window { x, y }),
        (None, None) => None,
        (given, _) => {
            let missing = if given.is_some() { "y" } else { "x" };
            let message = format!(
                "the window of this {title} has no {missing}; give x and y, or neither to have it fitted"
            );
            return Err(Complaint { at: read.span(), message });
        }
    };
    let variants = with.iter().map(variant).collect::<Result<Vec<_>, _>>()?;
    let family = (!variants.is_empty()).then(|| {
        families.push(variants);
        families.len() - 1
    });
    Ok(PlotSetup { view: *view, axes, window, family })
}

/// The values that a plot holds, each checked against the range of its parameter.
fn variant(read: &BTreeMap<Knob, Spanned<f64>>) -> Result<Variant, Complaint> {
    let held = |(knob, value): (&Knob, &Spanned<f64>)| Ok((*knob, checked(*knob, value)?));
    Ok(Variant { held: read.iter().map(held).collect::<Result<_, _>>()? })
}

/// The motion with the values of the file: a declared term has its value or its default, all others are zero.
fn of_values(read: &SceneFile, terms: &BTreeSet<Knob>) -> Result<Problem, Complaint> {
    let mut parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.0 };
    let mut initial = State { q: 0.0, v: 0.0 };
    for knob in Knob::MOTION {
        let declared = !knob.is_parameter() || terms.contains(&knob);
        let value = match read.values.get(&knob) {
            Some(given) if !declared => {
                return Err(Complaint {
                    at: given.span(),
                    message: format!("{knob} has a value but is not in terms; add \"{knob}\""),
                });
            }
            Some(given) => checked(knob, given)?,
            None if declared => knob.usual(),
            None => 0.0,
        };
        knob.set(&mut parameters, &mut initial, value);
    }
    Ok(Problem { parameters, initial, until: Knob::Until.usual(), ..Problem::default() })
}

/// A number from the file, checked against its range, or its default.
fn within(knob: Knob, given: Option<&Spanned<f64>>) -> Result<f64, Complaint> {
    given.map_or(Ok(knob.usual()), |given| checked(knob, given))
}

/// A number from the file, checked against its range.
fn checked(knob: Knob, given: &Spanned<f64>) -> Result<f64, Complaint> {
    knob.check(*given.get_ref())
        .map_err(|refused| Complaint { at: given.span(), message: refused.to_string() })
}

fn steps(given: &BTreeMap<Knob, Spanned<f64>>) -> Result<BTreeMap<Knob, f64>, Complaint> {
    given
        .iter()
        .map(|(symbol, step)| {
            let value = *step.get_ref();
            if value > 0.0 && value.is_finite() {
                Ok((*symbol, value))
            } else {
                let message = format!("a step of {symbol} is {value:?}; it must be positive");
                Err(Complaint { at: step.span(), message })
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"title = "A test"
look = "At this."
press = "That."
terms = ["D", "r"]
values = { D = -0.4, q0 = 2 }
layers = ["trajectory"]
plot = [
  { view = "phase", x = [-3, 3], y = [-2.5, 2.5] },
  { view = "diagram", over = "D", x = [-1, 0.1], y = [0, 2] },
]
"#;

    #[test]
    fn declared_terms_have_values_and_all_others_are_zero() {
        let scene = parse("test", "test.toml", GOOD).unwrap();
        let Problem { parameters, initial, .. } = scene.problem;
        assert_eq!(parameters, Parameters { d: -0.4, d2: 0.0, d3: 0.0, r: Knob::R.usual() });
        assert_eq!(initial, State { q: 2.0, v: 0.0 });
        assert!(scene.declares(Knob::R) && scene.declares(Knob::V0));
        assert!(!scene.declares(Knob::D3));
    }

    #[test]
    fn a_diagram_shows_q_max_over_d_unless_it_says_otherwise() {
        let scene = parse("test", "test.toml", GOOD).unwrap();
        assert_eq!(scene.plots[1].axes, Axes::default());
        let period = GOOD.replace("over = \"D\"", "over = \"r\", ordinate = \"period\"");
        let scene = parse("test", "test.toml", &period).unwrap();
        assert_eq!(
            scene.plots[1].axes,
            Axes { abscissa: Knob::R, ordinate: Ordinate::Period, ..Axes::default() }
        );
    }

    #[test]
    fn a_plot_without_a_window_is_fitted() {
        let fitted = GOOD.replace(", x = [-1, 0.1], y = [0, 2]", "");
        let scene = parse("test", "test.toml", &fitted).unwrap();
        assert!(scene.plots[0].window.is_some());
        assert_eq!(scene.plots[1].window, None);
        assert!(scene.plots[1].opening().x.contains(-0.4));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place_and_what_is_allowed() {
        for (from, to, place, words) in [
            ("title", "titel", "1:1", "expected one of `title`"),
            ("A test\"", "A test", "1:", ""),
            ("D = -0.4", "D = nan", "5:16", "D = NaN is outside its range -1e6 .. 1e6"),
            ("D = -0.4", "D3 = 1", "5:17", "add \"D3\""),
            ("D = -0.4", "D4 = 1", "5:12", "no number \"D4\"; did you mean D"),
            ("D = -0.4", "D = \"a\"", "5:16", "expected f64"),
            ("[-3, 3]", "[3, -3]", "8:25", "the second larger"),
            ("over = \"D\"", "over = \"q0\"", "9:30", "D, D2, D3 and r are allowed"),
            ("over", "ordinate = \"size\", over", "9:34", "expected one of `q_max`, `q_min`"),
            ("over", "unit = \"m\", over", "9:30", "expected `1` or `r`"),
            (
                "over",
                "ordinate = \"period\", unit = \"r\", over",
                "9:51",
                "period is not a length; leave its unit out",
            ),
            ("\"phase\"", "\"plane\"", "8:12", "unknown variant `plane`"),
            ("\"diagram\"", "\"phase\"", "9:28", "has no such axis"),
            (
                "view = \"diagram\", over",
                "view = \"regimes\", against = \"D\", over",
                "9:33",
                "two different axes; both are D",
            ),
            (", y = [0, 2]", "", "9:3", "has no y; give x and y, or neither"),
            ("\"trajectory\"", "\"tail\"", "6:11", "expected one of `trajectory`"),
            ("layers", "until = -1\nlayers", "6:9", "until = -1 is outside its range 0 .."),
            ("layers", "steps = { r = 0 }\nlayers", "6:15", "must be positive"),
        ] {
            let error = parse("test", "test.toml", &GOOD.replacen(from, to, 1)).unwrap_err();
            let line = error.to_string();
            assert!(line.starts_with(&format!("test.toml:{place}")), "{to}: {line}");
            assert!(line.contains(words) && !line.contains('\n'), "{to}: {line}");
        }
    }
}
