/** Numbers as text for people. */

/** Return a number with at most three digits that matter; "–" if there is none. */
export function number(value) {
  if (value === null || value === undefined) return "–";
  if (!Number.isFinite(Number(value))) return String(value);
  const size = Math.abs(value);
  const digits = size >= 100 ? 0 : size >= 10 ? 1 : 2;
  const text = size.toFixed(digits);
  return (value < 0 && Number(text) !== 0 ? "−" : "") + text;
}

/** Return a duration (s) as "12.3 s" or "2:05 min". */
export function seconds(value) {
  if (value === null || value === undefined) return "–";
  if (value < 60) return `${value.toFixed(1)} s`;
  const whole = Math.floor(value);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")} min`;
}
