import { Button, Checkbox, NativeSelect } from '@mantine/core';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { ResultName } from '@/generated/messages';
import { RESULTS } from '@/model/breakpoints';
import {
  blocksSkip,
  canForce,
  force,
  isOwnTree,
  nodeOf,
  nodesOf,
  release,
  stepTo,
} from '@/store/debug/debugger';
import { useDebugMarks } from '@/store/debug/marks';
import { useIsBack } from '@/store/moment/store';
import { liveKey } from '@/store/project/live';
import { useSessionStore } from '@/store/session/store';
import { useForcedWords } from './words';
import classes from './debug.module.css';

/** The results that can be forced in another program. */
const OF_OTHERS: readonly ResultName[] = ['SUCCESS', 'FAILURE'];

interface ForceFieldsProps {
  readonly tree: string;
  readonly node: string;
}

/** Forces the results of a block of the running tree, and lets a held tree continue to it. */
export function ForceFields({ tree, node }: ForceFieldsProps) {
  const { t } = useTranslation('debug');
  const session = useSessionStore();
  const isBack = useIsBack();
  const forced = useDebugMarks((state) => state.forced.get(liveKey(tree, node)));
  const words = useForcedWords();
  const [status, setStatus] = useState<ResultName>('SUCCESS');
  const [once, setOnce] = useState(false);
  const [after, setAfter] = useState(false);
  const nodes = nodesOf(session, tree, node);
  const one = nodeOf(session, tree, node);
  if (isBack || !one || !canForce()) return null;
  const isFreeze = status === 'RUNNING';
  const isOwn = isOwnTree(session);
  const blocking = isOwn ? blocksSkip(session.tree, one) : null;
  const results = isOwn ? RESULTS : OF_OTHERS;
  return (
    <>
      {forced && (
        <p className={classes['note']} role="status" data-testid="forced-words">
          {words(forced)}
        </p>
      )}
      <div className={classes['buttons']}>
        <NativeSelect
          size="xs"
          aria-label={t('force.result')}
          value={status}
          data={results.map((value) => ({ value, label: t(`force.choice.${value}`) }))}
          data-testid="force-status"
          onChange={({ currentTarget: { value } }) => setStatus(value as ResultName)}
        />
        <Checkbox
          size="md"
          label={t('force.once')}
          checked={once && !isFreeze}
          disabled={isFreeze}
          onChange={({ currentTarget: { checked } }) => setOnce(checked)}
        />
        <Checkbox
          size="md"
          label={t('force.after')}
          title={t('force.afterHelp')}
          checked={after && !isFreeze}
          disabled={isFreeze}
          onChange={({ currentTarget: { checked } }) => setAfter(checked)}
        />
        <Button
          size="compact-sm"
          variant="default"
          data-testid="force"
          onClick={() =>
            void force(nodes, {
              effect: 'result',
              status,
              once: once && !isFreeze,
              after: after && !isFreeze,
            })
          }
        >
          {t('force.do')}
        </Button>
        {forced && (
          <Button
            size="compact-sm"
            variant="default"
            data-testid="release"
            onClick={() => void release(nodes.map(({ uid }) => uid))}
          >
            {t('force.release')}
          </Button>
        )}
      </div>
      <div className={classes['buttons']}>
        {isOwn && session.held && (
          <Button size="compact-sm" variant="default" data-testid="step-to" onClick={() => void stepTo(one)}>
            {t('force.stepTo')}
          </Button>
        )}
        {isOwn && one.parent > 0 && (
          <>
            <Button
              size="compact-sm"
              variant="default"
              title={t('force.skipToHelp')}
              disabled={blocking !== null}
              onClick={() => void force([one], { effect: 'skip_to' })}
            >
              {t('force.skipTo')}
            </Button>
            <Button
              size="compact-sm"
              variant="default"
              title={t('force.aloneHelp')}
              onClick={() => void force([one], { effect: 'alone' })}
            >
              {t('force.alone')}
            </Button>
          </>
        )}
      </div>
      {blocking !== null && <p className={classes['note']}>{t('force.skipToNot', { type: blocking })}</p>}
      {nodes.length > 1 && (
        <p className={classes['note']}>{t('force.instances', { count: nodes.length, path: one.path })}</p>
      )}
    </>
  );
}
