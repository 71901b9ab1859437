//! Margins in words: the smallest kicks that are not survived, from the worst rest position first; nominal and
//! guaranteed, of the machine by the whole model and by its cubic expansion.

use super::{fitted::statement, pane};
use crate::model::Knob;
use crate::portrait::{Border, Margin, RestMargin};
use crate::question::CertainZones;
use crate::scene::Topic;
use crate::session::{MachineMargins, Session};
use crate::words::{joined, rounded_down, significant, too_large, with_unit_of};

/// Columns of a screen that has room for margins as forces too.
const WIDE: u16 = 110;

/// Digits of a margin. Where there is no room for them, fewer are better than a number that is cut.
const PLACES: usize = 4;

/// What a margin is called that holds whatever is not known exactly, and whatever disturbs.
const GUARANTEED: &str = "guaranteed";

const EVERY: &str = "every kick is survived";

/// The smallest kicks from where the spring is relaxed.
fn from_centre(margin: &Margin) -> RestMargin {
    RestMargin { displacement: margin.displacement, impulse: margin.impulse }
}

/// How kicks are written.
#[derive(Clone, Copy)]
struct KickNotation<'a> {
    session: &'a Session,
    places: usize,
    /// Whether shift and impulse have their names where no units tell them apart.
    named: bool,
    /// Whether the numbers are bounds, which must not be rounded up.
    bound: bool,
    /// The kick beside it, in SI units, in whose unit it is told.
    beside: Sizes,
}

/// The sizes of a shift and of an impulse.
pub type Sizes = [Option<f64>; 2];

/// Those of a kick, in the units of the machine or the record.
pub fn sizes(session: &Session, kick: RestMargin) -> Sizes {
    let of = |is_shift, size: Option<f64>| Some(size? * session.unit_of_kick(is_shift).0);
    [of(true, kick.displacement), of(false, kick.impulse)]
}

impl KickNotation<'_> {
    /// A shift and an impulse, in the units of the machine or the record; `None` where every kick is survived.
    fn kick(self, kick: RestMargin) -> Option<String> {
        if kick == RestMargin::default() {
            return None;
        }
        let named = self.named && self.session.units().is_none();
        let sizes = sizes(self.session, kick).into_iter().zip(self.beside);
        let texts = sizes.zip(["shift ", "impulse "]).map(|((size, beside), name)| {
            let (_, unit) = self.session.unit_of_kick(name == "shift ");
            let name = if named { name } else { "" };
            let size = size.map(|size| self.size(size, beside, unit));
            format!("{name}{}", size.unwrap_or_else(|| "any".to_owned()))
        });
        Some(joined(texts, ", "))
    }

    fn size(self, size: f64, beside: Option<f64>, unit: &str) -> String {
        let size = if self.bound {
            rounded_down(size, self.places)
        } else {
            size
        };
        with_unit_of(beside.unwrap_or(size), size, self.places, unit)
    }

    /// The kicks from where the spring is relaxed, after those from rest: in the same order, without their names.
    fn centre(self, margin: &Margin) -> Option<String> {
        let kick = KickNotation { named: false, ..self }.kick(from_centre(margin))?;
        let units = self.session.units().filter(|units| units.force.is_finite());
        // The force that holds the mass there.
        let force = units.zip(margin.displacement).filter(|_| self.session.size.width >= WIDE);
        let force = force.map(|(units, q)| format!(" ({})", self.size(q * units.force, None, "N")));
        let letter = if self.session.running().is_some() { "x" } else { "q" };
        Some(format!("from {letter} = 0: {kick}{}", force.unwrap_or_default()))
    }

    /// The headline.
    fn headline(self, margin: &Margin) -> String {
        match self.kick(margin.from_rest) {
            Some(_) if *margin == Margin::ZERO => "no kick is survived".to_owned(),
            Some(kick) => format!("margin from rest: {kick}"),
            None => EVERY.to_owned(),
        }
    }
}

/// The first of the texts that fits, with as many digits as possible.
fn fitting(session: &Session, width: usize, texts: impl Fn(KickNotation) -> Vec<String>) -> String {
    let ways = (1..=PLACES).rev();
    let beside = [None; 2];
    let ways =
        ways.map(|places| KickNotation { session, places, named: true, bound: false, beside });
    pane::fitting(ways.flat_map(texts), width)
}

/// The status line about margins, for a record what may be signed; `None` where they are not known.
pub fn status(session: &Session) -> Option<String> {
    let width = usize::from(session.size.width).saturating_sub(1);
    if session.scene.recording.is_some() {
        return statement(session, width);
    }
    let nominal = || machine(session, width).or_else(|| oscillator(session, width));
    certain(session, width).or_else(nominal)
}

/// What the pane says about the guaranteed margin, in a line of this width.
pub fn brief_guaranteed(session: &Session, width: usize) -> Option<String> {
    match &zones(session)?.guaranteed {
        Err(_) => Some("guaranteed: no kick".to_owned()),
        Ok(sure) if sure.from_rest == RestMargin::default() => {
            Some("guaranteed: every kick".to_owned())
        }
        Ok(sure) => in_pane(session, (GUARANTEED, sure), [None; 2], width),
    }
}

/// What the pane says about a margin of this name, in the units of another one, in a line of this width.
pub fn in_pane(
    session: &Session,
    (name, margin): (&str, &Margin),
    beside: Sizes,
    width: usize,
) -> Option<String> {
    let bound = name == GUARANTEED;
    let all = (1..=PLACES).rev().flat_map(|places| [(places, true), (places, false)]);
    let mut texts = all.filter_map(|(places, named)| {
        let write = KickNotation { session, places, named, bound, beside };
        Some(format!("{name} {}", write.kick(margin.from_rest)?))
    });
    texts.find(|text| text.chars().count() <= width)
}

/// The size of a kick, in the unit of a machine or a record in which another size is told.
pub fn told(session: &Session, is_shift: bool, sizes: [f64; 2], digits: usize) -> String {
    let (one, unit) = session.unit_of_kick(is_shift);
    let [size, other] = sizes.map(|size| size * one);
    with_unit_of(other, size, digits, unit)
}

/// The guaranteed margin of a shift from where the spring is relaxed, or of an impulse from rest, where there is one.
pub fn guaranteed(session: &Session, is_shift: bool) -> Option<f64> {
    let margin = zones(session)?.guaranteed.as_ref().ok()?;
    if is_shift {
        margin.displacement
    } else {
        margin.from_rest.impulse
    }
}

/// What is guaranteed, where it is to be told and is known.
fn zones(session: &Session) -> Option<&CertainZones> {
    let told = session.on_show().any(|plot| session.tells_certain(plot));
    if !told || session.value(Knob::R) == 0.0 {
        return None;
    }
    session.zones().filter(|_| !session.is_stale(Topic::Zones, session.plot))
}

/// Nominal and guaranteed.
fn certain(session: &Session, width: usize) -> Option<String> {
    let CertainZones { nominal, guaranteed, .. } = zones(session)?;
    let beside = sizes(session, nominal.from_rest);
    let texts = |write: KickNotation| {
        let headline = write.headline(nominal);
        let sure = match guaranteed {
            Ok(sure) => sure,
            Err(why) => {
                let nothing = format!("nothing is guaranteed: {why}");
                return vec![format!("{headline}; {nothing}"), nothing];
            }
        };
        let [named, unnamed] =
            [true, false].map(|named| KickNotation { named, bound: true, beside, ..write });
        let [told, brief] = [named, unnamed].map(|write| {
            let kick = write.kick(sure.from_rest);
            format!("{headline}; guaranteed: {}", kick.as_deref().unwrap_or("every kick"))
        });
        let centre = write.centre(nominal).zip(unnamed.kick(from_centre(sure)));
        let centre = centre.map(|(own, sure)| format!("{told}; {own}; guaranteed: {sure}"));
        centre.into_iter().chain([told, brief]).collect()
    };
    Some(fitting(session, width, texts))
}

fn oscillator(session: &Session, width: usize) -> Option<String> {
    let found = session.cycles().filter(|_| !session.is_stale(Topic::Cycles, session.plot))?;
    if found.parameters.r == 0.0 {
        return None;
    }
    if found.portrait.border == Border::None {
        return Some(EVERY.to_owned());
    }
    Some(fitting(session, width, |write| {
        let headline = write.headline(&found.margin);
        let centre = write.centre(&found.margin).map(|centre| format!("{headline}; {centre}"));
        let proved = centre.as_ref().zip(found.lyapunov_share.map(share));
        let proved = proved.map(|(centre, share)| format!("{centre} ({share})"));
        let told = proved.as_deref().or(centre.as_deref()).map(defined);
        [told, proved, centre, Some(headline)].into_iter().flatten().collect()
    }))
}

/// A sentence about the margin, with what that is.
fn defined(text: &str) -> String {
    format!("{text}; a margin is the smallest kick that is not survived")
}

/// How much of the margin from the centre the Lyapunov circle (24) proves. It accounts for linear damping only: where
/// D2 or D3 feed the motion it can be larger than the basin.
pub fn share(share: f64) -> String {
    if share > 1.0 {
        return "Lyapunov: not valid".to_owned();
    }
    format!("Lyapunov proves {} %", significant(100.0 * share, 2))
}

/// The margin of a machine by the model on show, and by how much the expansion is wrong.
fn machine(session: &Session, width: usize) -> Option<String> {
    let fresh = !session.is_stale(Topic::Cycles, session.plot);
    let MachineMargins { whole, cubic } = session.machine_margins().filter(|_| fresh)?;
    session.running()?;
    let error = match (whole.from_rest.displacement, cubic.from_rest.displacement) {
        (Some(own), Some(other)) if own > 0.0 => too_large(other / own - 1.0),
        (Some(_), None) => EVERY.to_owned(),
        (None, Some(_)) => "not every kick is survived".to_owned(),
        _ => "the same".to_owned(),
    };
    Some(fitting(session, width, |write| {
        let [own, other] = [whole, cubic].map(|margin| write.headline(&margin));
        if session.draws_whole() {
            let both = format!("{own}; cubic expansion: {error}");
            let centre = write.centre(&whole).map(|centre| format!("{both}; {centre}"));
            let cubic = Some(format!("{own} (cubic: {error})"));
            let all = [centre.as_deref().map(defined), centre, Some(both), cubic];
            return all.into_iter().flatten().collect();
        }
        let cubic = format!("cubic expansion: {other} ({error})");
        vec![format!("{cubic}; whole model: {own}"), cubic, format!("cubic {other} ({error})")]
    }))
}
