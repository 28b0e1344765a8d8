import type { TFunction } from 'i18next';
import type { Outcome } from '@/api/evaluations';

const DIGITS = 3;

/** Returns a number with three significant digits, without zeros at its end. */
export const short = (value: number): string => String(Number(value.toPrecision(DIGITS)));

/** Returns a share as a percentage. */
export const percent = (share: number): string => `${Number((share * 100).toFixed(1))} %`;

/** Returns what a cell says: its seed, outcome, time and margin. */
export function outcomeText(t: TFunction<'evaluate'>, seed: number, row: Outcome | undefined): string {
  if (!row) return t('cell.none', { seed });
  const margin =
    row.margin === null ? '' : t('cell.margin', { margin: short(row.margin), unit: row.unit }).trimEnd();
  const text = t('cell.text', { seed, outcome: t(`outcome.${row.outcome}`), end: short(row.end_s) });
  return margin ? `${text}, ${margin}` : text;
}

/** Returns a length of time in words, such as "3 min 20 s". */
export function duration(seconds: number): string {
  const whole = Math.round(seconds);
  const hours = Math.floor(whole / 3600);
  const minutes = Math.floor((whole % 3600) / 60);
  if (hours > 0) return `${hours} h ${minutes} min`;
  return minutes > 0 ? `${minutes} min ${whole % 60} s` : `${whole} s`;
}
