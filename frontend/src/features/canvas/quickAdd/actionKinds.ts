import type { ActionKind } from '@/store/project/edits/actionTemplate';

/** Returns the kinds of action for a name. For a name that is a question, conditions come first. */
export function kindsFor(name: string): readonly ActionKind[] {
  const isQuestion = /^([Ii]s|[Hh]as|[Cc]an|[Cc]heck)([A-Z_]|$)/.test(name);
  const leaves = isQuestion ? (['Condition', 'Action'] as const) : (['Action', 'Condition'] as const);
  return [...leaves, 'Control', 'Decorator'];
}
