import type { TFunction } from 'i18next';
import { ApiError } from '@/api/errors';
import { PackError } from './pack';

/** Why an import failed, in one sentence each, with what can be done. */
export interface Failure {
  readonly message: string;
  readonly hint: string;
  /** `file:line` of the place in the upload; empty if there is none. */
  readonly place: string;
}

/** The refusals that have a text here, by their code. */
const REFUSALS = [
  'busy',
  'disk_full',
  'import_unavailable',
  'offline',
  'project_archived',
  'role_too_low',
] as const;

/** Returns a place in the upload as text. */
export const placeOf = (file: string | null | undefined, line: number | null | undefined): string =>
  file ? (line ? `${file}:${line}` : file) : '';

const MEGABYTE = 1 << 20;

/** Returns each reason of a failure. */
export function failuresOf(t: TFunction<'importing'>, error: Error): readonly Failure[] {
  if (error instanceof PackError) {
    const value = error.reason === 'bytes' ? Math.round(Number(error.value) / MEGABYTE) : error.value;
    return [
      { message: t(`pack.${error.reason}`, { value }), hint: t(`packHint.${error.reason}`), place: '' },
    ];
  }
  if (!(error instanceof ApiError)) return [{ message: error.message, hint: '', place: '' }];
  const code = REFUSALS.find((each) => each === error.code);
  if (code !== undefined) return [{ message: t(`refused.${code}`), hint: '', place: '' }];
  if (error.diagnostics.length > 0) {
    return error.diagnostics.map(({ message, hint, file, line }) => ({
      message,
      hint: hint ?? '',
      place: placeOf(file, line),
    }));
  }
  return [{ message: error.message, hint: error.hint, place: '' }];
}
