import type { ActionKind } from '@/store/project/edits/actionTemplate';

/** A name that is a question is probably a condition: that choice comes first. */
export function kindsFor(name: string): readonly ActionKind[] {
  return /^([Ii]s|[Hh]as|[Cc]an|[Cc]heck)([A-Z_]|$)/.test(name)
    ? ['Condition', 'Action']
    : ['Action', 'Condition'];
}
