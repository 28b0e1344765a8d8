import type { ActionKind } from '@/store/project/edits/actionTemplate';

const MOST_CHILDREN: Readonly<Record<ActionKind, number>> = {
  Action: 0,
  Condition: 0,
  Control: Infinity,
  Decorator: 1,
};

/**
 * Returns the kinds of a new node that can have this many children, the most likely first. For a name that is
 * a question, conditions come before actions; round one block a decorator comes first.
 */
export function kindsFor(name: string, children = 0): readonly ActionKind[] {
  const isQuestion = /^([Ii]s|[Hh]as|[Cc]an|[Cc]heck)([A-Z_]|$)/.test(name);
  const leaves = isQuestion ? (['Condition', 'Action'] as const) : (['Action', 'Condition'] as const);
  const inner = children === 1 ? (['Decorator', 'Control'] as const) : (['Control', 'Decorator'] as const);
  return [...leaves, ...inner].filter((kind) => MOST_CHILDREN[kind] >= children);
}
