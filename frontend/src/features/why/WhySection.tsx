import { NativeSelect } from '@mantine/core';
import { useEffect, useMemo, useRef, useState } from 'react';
import type { TreeNode } from '@/generated/messages';
import { explain, type Step } from '@/model/why/explain';
import type { Reason } from '@/model/why/verdict';
import { useShownSession } from '@/store/moment/session';
import { useIsBack } from '@/store/moment/store';
import { useShownTick, useWhy } from '@/store/moment/why';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { usePlainWords } from '@/ui/hooks/usePlainWords';
import { nameOf, question, sentence, statusOf } from './sentence';
import classes from './why.module.css';

interface WhySectionProps {
  readonly tree: string;
  readonly node: string;
}

/** Why a block was ticked in the shown tick or was not: the path from the root, with the reason at each parent. */
export function WhySection({ tree, node }: WhySectionProps) {
  const t = usePlainWords('why');
  const nodes = useShownSession((state) => state.tree);
  const isOpen = useWhy((state) => state.isOpen);
  const asked = useWhy((state) => state.asked);
  const head = useRef<HTMLElement>(null);
  const instances = useMemo(
    () => nodes.filter(({ tree_id, node_id }) => tree_id === tree && node_id === node),
    [nodes, tree, node],
  );
  const answered = useRef(asked);
  useEffect(() => {
    if (answered.current === asked) return;
    answered.current = asked;
    head.current?.focus();
    head.current?.scrollIntoView({ block: 'nearest' });
  }, [asked]);
  if (instances.length === 0) return null;
  return (
    <details
      className={classes['why']}
      open={isOpen}
      data-testid="why"
      onToggle={({ currentTarget }) => {
        if (currentTarget.open !== isOpen) useWhy.setState({ isOpen: currentTarget.open });
      }}
    >
      <summary ref={head} className={classes['title']}>
        {t('title')}
      </summary>
      {isOpen && <Answer key={`${tree}/${node}`} instances={instances} />}
    </details>
  );
}

function Answer({ instances }: { readonly instances: readonly TreeNode[] }) {
  const t = usePlainWords('why');
  const [chosen, setChosen] = useState(0);
  const shown = useShownTick(true);
  const hold = useSessionStore(({ held, heldInPython }) => held ?? heldInPython);
  const isBack = useIsBack();
  const uid = (instances[chosen] ?? instances[0])?.uid ?? 0;
  const answer = useMemo(() => (shown ? explain(shown.facts, uid) : null), [shown, uid]);
  const last = answer?.steps.at(-1);
  const isReached = last?.uid === uid;
  return (
    <div className={classes['answer']}>
      {instances.length > 1 && (
        <NativeSelect
          size="xs"
          aria-label={t('instance')}
          value={String(chosen)}
          data={instances.map(({ path }, at) => ({ value: String(at), label: path }))}
          onChange={({ currentTarget }) => setChosen(Number(currentTarget.value))}
        />
      )}
      {hold && !isBack && (
        <p className={classes['note']} data-testid="why-held">
          {t(hold.path.includes(uid) ? 'heldHere' : 'held', { n: hold.tick })}
        </p>
      )}
      {shown && answer && last ? (
        <>
          <p className={classes['question']} data-testid="why-question">
            {isReached ? question(t, last.verdict) : t('question.notReached')}{' '}
            <span className={classes['tick']}>{t('tick', { n: shown.number })}</span>
          </p>
          {shown.isHalted && <p className={classes['note']}>{t('halted')}</p>}
          <ol className={classes['steps']} aria-label={t('path')}>
            {answer.steps.map((step) => (
              <StepLine
                key={step.uid}
                step={step}
                nodes={shown.nodes}
                isForced={shown.facts.forced?.has(step.uid) ?? false}
              />
            ))}
            {answer.outcome && <OutcomeLine reason={answer.outcome} uid={uid} nodes={shown.nodes} />}
          </ol>
        </>
      ) : (
        <p className={classes['note']}>{t('noTick')}</p>
      )}
    </div>
  );
}

const select = (node: TreeNode | undefined) => {
  if (node?.node_id) useProjectStore.getState().reveal(node.tree_id, node.node_id);
};

interface StepProps {
  readonly step: Step;
  readonly nodes: readonly TreeNode[];
  readonly isForced: boolean;
}

function StepLine({ step, nodes, isForced }: StepProps) {
  const t = usePlainWords('why');
  const { uid, parent, verdict } = step;
  const status = statusOf(verdict);
  return (
    <li>
      <button
        type="button"
        className={classes['step']}
        data-testid="why-step"
        data-uid={uid}
        data-reason={verdict.reason.code}
        onClick={() => select(nodes.find((node) => node.uid === uid))}
      >
        <span>{sentence(t, nodes, verdict.reason, uid, parent)}</span>{' '}
        <span className={classes['status']} data-status={status}>
          {t(`status.${status}`)}
        </span>
        {isForced && <span className={classes['forced']}>{t('forced')}</span>}
      </button>
    </li>
  );
}

interface OutcomeProps {
  readonly reason: Reason;
  readonly uid: number;
  readonly nodes: readonly TreeNode[];
}

/** Why the node itself has its result: the child that decided it, or its own reason not to tick one. */
function OutcomeLine({ reason, uid, nodes }: OutcomeProps) {
  const t = usePlainWords('why');
  const { code, by } = reason;
  const child = nodes.find((node) => node.uid === by) ?? nodes.find(({ parent }) => parent === uid);
  const words =
    code === 'after'
      ? t('outcome', { ...namesOf(nodes, uid, by), status: reason.status ?? '' })
      : sentence(t, nodes, reason, child?.uid ?? 0, uid);
  return (
    <li>
      <button
        type="button"
        className={classes['step']}
        data-testid="why-outcome"
        onClick={() => select(code === 'forced' ? nodes.find((node) => node.uid === uid) : child)}
      >
        {words}
      </button>
    </li>
  );
}

const namesOf = (nodes: readonly TreeNode[], uid: number, by: number | undefined) => ({
  parent: nameOf(nodes.find((node) => node.uid === uid)),
  by: nameOf(nodes.find((node) => node.uid === by)),
});
