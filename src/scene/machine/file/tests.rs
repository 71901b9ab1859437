use super::*;
use crate::scene::Machine;

const GOOD: &str = r#"title = "A test"
m = "250 g"
c = "0.4 N/mm"
F = "20 N"
R = 0.5
v0 = "20 cm/s"
friction.constant = { mu = 0.25 }
start = { x = "2 mm", v = "-1 cm/s" }
"#;

fn nothing(_: &str) -> Result<String, String> {
    Err("no file".to_owned())
}

fn read(text: &str) -> Result<Machine, FileMistake> {
    Ok(parse("test", "test.toml", text, nothing)?.try_into().unwrap())
}

#[test]
fn quantities_are_read_with_their_units_and_have_defaults() {
    let machine = read(GOOD).unwrap();
    let belt = &machine.belt;
    assert_eq!((belt.mass, belt.stiffness, belt.normal_force), (0.25, 400.0, 20.0));
    assert_eq!((belt.friction, belt.belt_speed, belt.damping), (0.5, 0.2, 0.0));
    assert_eq!((machine.displacement, machine.velocity), (0.002, -0.01));
    // omega_0 = 40/s; the default is twenty periods.
    assert!((machine.until - std::f64::consts::PI).abs() < 1e-12);
}

#[test]
fn every_law_is_read() {
    for (friction, at, mu) in [
        ("polynomial = { coefficients = [0.5, \"-1 s/m\", 0.25] }", 0.2, 0.31),
        ("stribeck = { rest = 0.4, kinetic = 0.2, velocity = \"20 cm/s\" }", 0.0, 0.4),
        ("stribeck = { rest = 0.4, kinetic = 0.2, velocity = 1, viscous = \"1 s/m\" }", 0.0, 0.4),
        ("table = { points = [[0, 0.4], [\"10 cm/s\", 0.3], [0.2, 0.25], [0.4, 0.2]] }", 0.1, 0.3),
    ] {
        let text = GOOD.replace("constant = { mu = 0.25 }", friction);
        let machine = read(&text).unwrap_or_else(|error| panic!("{friction}: {error}"));
        assert!((machine.belt.law.mu(at).unwrap() - mu).abs() < 1e-12, "{friction}");
    }
}

#[test]
fn a_table_may_stand_in_a_file_of_its_own() {
    let text = GOOD.replace("constant = { mu = 0.25 }", "table = { file = \"mu.csv\" }");
    let csv = "# measured\nv [mm/s],mu\n0,0.4\n100,0.3 # here\n\n20 cm/s,0.25\n400,0.2\n";
    let machine = parse("test", "test.toml", &text, |name| {
        assert_eq!(name, "mu.csv");
        Ok(csv.to_owned())
    });
    let machine = Machine::try_from(machine.unwrap()).unwrap();
    let FrictionLaw::Table(spline) = machine.belt.law else { panic!("a table") };
    assert_eq!((spline.points(), spline.range()), (4, (0.0, 0.4)));
    let missing = read(&text).unwrap_err().to_string();
    assert_eq!(missing, "test.toml:7:27: no file");
    let expected = table("mu.csv", csv).unwrap();
    for same in [
        "v [mm/s];mu\n0;0,4\n100,0;0,3\n20 cm/s;0,25\n400;0,2\n",
        "v [mm/s]\tmu\n0\t0.4\n100\t0,3\n200\t0.25\n400\t0,2\n",
    ] {
        assert_eq!(table("mu.csv", same).as_ref(), Ok(&expected), "{same}");
    }
    for (bad, words) in [
        ("0,0.4\nv,mu\n", "mu.csv:2:"),
        ("0,0.4,5\n", "mu.csv:1: \"0,0.4,5\" is not a velocity and a coefficient"),
        ("0,0.4\n1 kg,0.3\n", "mu.csv:2: \"1 kg\" has the wrong unit; it takes one such as m/s"),
        ("0,0.4\n1,x\n", "mu.csv:2: \"x\" is not a number"),
        ("0,0.4\n", "a table needs 4 points or more, not 1"),
        ("0,1\n1,1\n1,1\n2,1\n", "point 3: numbers must be finite, velocities must increase"),
        ("", "4 points or more, not 0"),
    ] {
        let error = parse("test", "test.toml", &text, |_| Ok(bad.to_owned())).unwrap_err();
        let line = error.to_string();
        assert!(line.starts_with("test.toml:7:27: ") && line.contains(words), "{bad:?}: {line}");
    }
}

#[test]
fn static_friction_stands_beside_the_law_and_never_below_it() {
    let text = GOOD.replace("friction.constant", "friction.static = 0.3\nfriction.constant");
    let text = text.replace("R = 0.5", "R = 0.5\nR_static = \"0.8 N\"");
    let belt = read(&text).unwrap().belt;
    assert_eq!((belt.static_coefficient, belt.static_guide), (Some(0.3), Some(0.8)));
    assert_eq!(read(GOOD).unwrap().belt.static_coefficient, None);
    let below = read(&text.replace("static = 0.3", "static = 0.2")).unwrap_err().to_string();
    assert!(
        below.contains("mu_s = 0.2 is below the coefficient 0.25 of the law at rest"),
        "{below}"
    );
    let two = GOOD.replace("start =", "friction.polynomial = { coefficients = [1] }\nstart =");
    let two = read(&two).unwrap_err().to_string();
    assert!(
        two.contains("friction takes one law: constant, polynomial, stribeck or table"),
        "{two}"
    );
}

#[test]
fn tolerances_and_a_disturbance_stand_beside_the_values() {
    let text = GOOD.replace("R = 0.5", "R = \"0.5 N +- 10 %\"\ndisturbance = \"50 mN\"");
    let text =
        text.replace("mu = 0.25", "mu = \"0.24 .. 0.26\"").replace("title = \"A test\"\n", "");
    let machine = read(&text).unwrap();
    assert_eq!((machine.belt.friction, machine.tolerances.disturbance), (0.5, 0.05));
    assert_eq!(machine.title, "test");
    let half_widths = &machine.tolerances.half_widths;
    assert_eq!(half_widths.keys().collect::<Vec<_>>(), ["R", "mu"]);
    assert!((half_widths["R"] - 0.05).abs() < 1e-15 && (half_widths["mu"] - 0.01).abs() < 1e-15);
    let stays = serde_json::from_str(&serde_json::to_string(&machine).unwrap()).unwrap();
    assert_eq!(machine, stays);
    for (from, to, words) in [
        ("10 %", "2 N", "R = -1.5 N is outside its range 0 .."),
        ("10 %", "2 mm", "both numbers take the same unit"),
        ("50 mN", "1 mm", "disturbance = 1 mm has the wrong unit; it takes one such as N"),
        ("50 mN", "-1 N", "disturbance = -1 N is outside its range"),
    ] {
        let refused = read(&text.replace(from, to)).unwrap_err().to_string();
        assert!(refused.contains(words), "{to}: {refused}");
    }
}

#[test]
fn what_is_wrong_is_said_with_its_place_and_what_is_allowed() {
    for (from, to, place, words) in [
        ("title", "titel", "1:1", "no number \"titel\"; did you mean title? there are m, c, d1"),
        (
            "\"250 g\"",
            "\"250 mm\"",
            "2:5",
            "m = 250 mm has the wrong unit; it takes one such as kg",
        ),
        ("\"250 g\"", "-1", "2:5", "m = -1 kg is outside its range 1e-12 .."),
        ("\"250 g\"", "nan", "2:5", "m = NaN kg is outside its range"),
        ("\"250 g\"", "9223372036854775808", "2:5", "is outside its range"),
        ("\"250 g\"", "0x99999999999999999", "2:5", "a whole number beyond 64 bits"),
        ("\"250 g\"", "1e999", "2:5", "floating-point number overflowed"),
        ("\"250 g\"", "1979-05-27", "2:5", "a date or a time; nothing here is one"),
        ("\"250 g\"", "\"250 gr\"", "2:5", "\"gr\" is not a unit"),
        ("\"250 g\"", "[1]", "2:5", "a number, or a text such as"),
        ("m = \"250 g\"\n", "", "1:1", "m (mass) is missing; such as m = \"1 kg\""),
        ("mu = 0.25", "mu = 0", "7:1", "mu = 0 at v0 = 0.2 m/s; it must be positive"),
        ("mu = 0.25", "mu = \"3 m\"", "7:28", "mu = 3 m has a unit; it takes none"),
        ("mu = 0.25", "my = 0.25", "7:", "no number \"my\"; there are mu"),
        ("constant", "coulomb", "7:", "there are static, constant"),
        ("constant = { mu = 0.25 }", "table = {}", "7:1", "either file = "),
        ("\"2 mm\"", "\"2 s\"", "8:15", "x = 2 s has the wrong unit; it takes one such as m"),
        ("\"2 mm\"", "1e7", "8:15", "x = 10000000 m is outside its range"),
        ("start", "until = -1\nstart", "8:9", "until = -1 s is outside its range 0 .. 1e6 s"),
    ] {
        let error = read(&GOOD.replacen(from, to, 1)).expect_err(to);
        let line = error.to_string();
        assert!(line.starts_with(&format!("test.toml:{place}")), "{to}: {line}");
        assert!(line.contains(words) && !line.contains('\n'), "{to}: {line}");
    }
}
