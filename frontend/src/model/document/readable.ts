const significant = (value: number, digits: number): number => Number(value.toPrecision(digits));

/**
 * Rounds a number for display: to millimetres (0.1 mm below 1 m), and angles and angular rates to three
 * digits. Stored numbers keep their precision.
 */
export function readable(value: number, unit = ''): number {
  if (!Number.isFinite(value)) return value;
  if (unit.includes('°')) return Math.abs(value) >= 100 ? Math.round(value) : significant(value, 3);
  const decimals = Math.abs(value) >= 1 ? 1e3 : 1e4;
  return Math.round(value * decimals) / decimals;
}
