import type { TFunction } from 'i18next';
import type { Mark } from '@/store/recording/types';

/** Returns what a mark tells: its kind, time, first line, and who set a flag. */
export function labelOf(t: TFunction<'axis'>, { kind, t: at, text, user }: Mark): string {
  const values = { t: at.toFixed(2), text: text.split('\n')[0] ?? '', user: user ?? '' };
  return kind === 'flag' && user ? t('mark.flagBy', values) : t(`mark.${kind}`, values);
}

/** Returns what is missing where the recording stopped, and what the user can do; empty for other marks. */
export function adviceOf(t: TFunction<'axis'>, { kind, stop }: Mark): string {
  if (kind !== 'stopped') return '';
  if (!stop || stop.goes_on) return t('stopped.goesOn');
  return `${t('stopped.missing')} ${t(`stopped.${stop.reason}`)}`;
}
