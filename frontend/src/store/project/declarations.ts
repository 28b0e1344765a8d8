import type { ActionModel } from '@/api/types';

/**
 * The codes of an action that cannot be read: its Python has a syntax error, or lacks the class. Both come
 * and go while the user types.
 */
const UNREADABLE: readonly string[] = ['BT0601', 'BT0602'];

const isUnreadable = ({ diagnostics = [] }: ActionModel): boolean =>
  diagnostics.some(({ code }) => UNREADABLE.includes(code));

/**
 * Returns the actions after a check. An action whose Python cannot be read keeps its last declaration, which
 * is marked as outdated.
 */
export function withLastDeclarations(
  before: readonly ActionModel[],
  now: readonly ActionModel[],
): readonly ActionModel[] {
  if (!now.some(isUnreadable)) return now;
  const earlier = new Map(before.map((action) => [action.name, action]));
  return now.map((action) => {
    const last = earlier.get(action.name);
    if (!last || !isUnreadable(action) || (isUnreadable(last) && !last.outdated)) return action;
    return { ...last, diagnostics: action.diagnostics ?? [], outdated: true };
  });
}
