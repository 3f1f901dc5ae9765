"use strict";
for (const button of document.querySelectorAll("table.sortable th button")) {
  button.addEventListener("click", () => {
    const header = button.parentElement, row = header.parentElement;
    const body = header.closest("table").tBodies[0], place = header.cellIndex;
    const up = header.getAttribute("aria-sort") !== "ascending";
    for (const other of row.cells) other.removeAttribute("aria-sort");
    header.setAttribute("aria-sort", up ? "ascending" : "descending");
    const order = new Intl.Collator("en", { numeric: true });
    const rows = Array.from(body.rows);
    rows.sort((a, b) => (up ? 1 : -1) * order.compare(a.cells[place].textContent, b.cells[place].textContent));
    body.append(...rows);
  });
}
