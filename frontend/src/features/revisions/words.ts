import type { TFunction } from 'i18next';
import type { Revision } from '@/api/revisions';

/** The messages that the server and autosaving write, with the keys of their translations. */
const KNOWN: readonly (readonly [RegExp, string])[] = [
  [/^Edit (\d+) files$/, 'message.editMany'],
  [/^Edit (.+)$/, 'message.edit'],
  [/^Create the project$/, 'message.create'],
  [/^Import$/, 'message.import'],
  [/^Duplicate of (.+)$/, 'message.duplicate'],
  [/^Restore revision (\d+)$/, 'message.restore'],
  [/^Rename the project$/, 'message.rename'],
  [/^Change the settings$/, 'message.settings'],
];

/** Returns the message of a revision, translated if the server or autosaving wrote it. */
export function sayRevision({ message, number }: Revision, t: TFunction<'revisions'>): string {
  for (const [pattern, key] of KNOWN) {
    const found = pattern.exec(message);
    if (found) return t(key as 'message.edit', { what: (found[1] ?? '').replaceAll('.json', '') });
  }
  return message || t('unnamed', { number });
}
