fn main() {
    let mut a = std::env::args().skip(1);
    let gz = std::fs::read(a.next().unwrap()).unwrap();
    std::fs::write(a.next().unwrap(), rocking_report::lab::page(&gz).unwrap())
        .unwrap();
}
