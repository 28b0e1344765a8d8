const significant = (value: number, digits: number): number => Number(value.toPrecision(digits));

/**
 * A number as a person reads it: millimetres and thousandths, angles and angular rates with three digits.
 * It is for display only: what is stored keeps its precision.
 */
export function readable(value: number, unit = ''): number {
  if (!Number.isFinite(value)) return value;
  if (unit.includes('°')) return Math.abs(value) >= 100 ? Math.round(value) : significant(value, 3);
  const decimals = Math.abs(value) >= 1 ? 1e3 : 1e4;
  return Math.round(value * decimals) / decimals;
}
