"use strict";
const order = new Intl.Collator("en", { numeric: true });
const compare = (a, b) => {
  const numbers = a !== "" && b !== "" ? Number(a) - Number(b) : NaN;
  return Number.isNaN(numbers) ? order.compare(a, b) : numbers;
};
for (const button of document.querySelectorAll("table.sortable th button")) {
  button.addEventListener("click", () => {
    const header = button.parentElement, row = header.parentElement;
    const body = header.closest("table").tBodies[0], place = header.cellIndex;
    const up = header.getAttribute("aria-sort") !== "ascending";
    for (const other of row.cells) other.removeAttribute("aria-sort");
    header.setAttribute("aria-sort", up ? "ascending" : "descending");
    const rows = Array.from(body.rows, (line) => [line.cells[place].textContent, line]);
    rows.sort(([a], [b]) => (up ? 1 : -1) * compare(a, b));
    body.append(...rows.map(([, line]) => line));
  });
}
