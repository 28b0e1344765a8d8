import type { TFunction } from 'i18next';
import type { NodeStatus, TreeNode } from '@/generated/messages';
import type { Reason, Verdict } from '@/model/why/verdict';

/** Returns the name of a node as the canvas shows it. */
export const nameOf = (node: TreeNode | undefined): string =>
  node ? node.name.replace(/::\d+$/, '') || node.type : '';

/** Returns a reason in words. `child` is the node that was ticked or not, `parent` the one that decided it. */
export function sentence(
  t: TFunction<'why'>,
  nodes: readonly TreeNode[],
  reason: Reason,
  child: number,
  parent: number,
): string {
  const name = (uid: number | undefined) => nameOf(nodes.find((node) => node.uid === uid));
  const { code, by, status, conditions } = reason;
  const words = conditions?.join(` ${t('or')} `);
  const of = {
    ...{ child: name(child), parent: name(parent), by: name(by), status: status ?? '' },
    conditions: words === undefined || words === '' ? t('aCondition') : words,
  };
  return t(`reason.${code}`, of);
}

/** Returns the question that is answered for a node. */
export function question(t: TFunction<'why'>, verdict: Verdict | null): string {
  if (!verdict || verdict.ticked === 'unknown') return t('question.open');
  if (verdict.ticked === 'no') return t('question.notTicked');
  return verdict.result === null ? t('question.ticked') : t('question.result', { status: verdict.result });
}

export const statusOf = (verdict: Verdict): NodeStatus | 'notTicked' | 'unknown' =>
  verdict.ticked === 'no' ? 'notTicked' : (verdict.result ?? 'unknown');
