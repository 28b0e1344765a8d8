import { Button, Group, NativeSelect, Progress } from '@mantine/core';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { SourceCall, TickSource } from '@/generated/messages';
import { askSource, sourceAt, stopSource, whyNoSource } from '@/store/moment/rerun/sourceOfTick';
import { useSource } from '@/store/moment/source';
import { useMoment } from '@/store/moment/store';
import { useSessionStore } from '@/store/session/store';
import { useTickSource } from '@/store/session/trace/tickSource';
import { usePlainWords } from '@/ui/hooks/usePlainWords';
import { CallValues } from './CallValues';
import { RanCode } from './RanCode';
import classes from './source.module.css';

interface SourceViewProps {
  /** The number of the selected block; null without one. */
  readonly uid: number | null;
}

/** The code that the actions ran in the shown tick, got by making the run again up to there. */
export function SourceView({ uid }: SourceViewProps) {
  const t = usePlainWords('axis');
  const job = useTickSource((state) => state.job);
  const tickT = useMoment((state) => state.shown?.tickT);
  useSource();
  const reason = useSessionStore(whyNoSource);
  const at = sourceAt(job, tickT);
  const found = at?.found ?? null;
  return (
    <div className={classes['view']} data-testid="past-source">
      {found && found.problem === '' ? (
        <Found key={`${found.job} ${uid}`} source={found} uid={uid} />
      ) : at && !found ? (
        <Going fraction={at.fraction} />
      ) : (
        <div className={classes['ask']}>
          {found ? (
            <p role="alert" className={classes['problem']}>
              {t('source.failed', { reason: found.problem })}
            </p>
          ) : null}
          <p className={classes['note']}>{reason ? t(`source.none.${reason}`) : t('source.help')}</p>
          {reason ? null : (
            <Button size="xs" onClick={() => void askSource()} data-testid="source-ask">
              {t(found ? 'source.again' : 'source.ask')}
            </Button>
          )}
        </div>
      )}
    </div>
  );
}

/** How far the run is made again, with a button that ends it. */
function Going({ fraction }: { readonly fraction: number }) {
  const { t } = useTranslation('axis');
  return (
    <Group gap="sm" p="sm" data-testid="source-going">
      <span role="status">{t('source.going')}</span>
      <Progress flex={1} miw={80} value={Math.round(fraction * 100)} aria-label={t('source.going')} />
      <Button size="compact-sm" variant="default" onClick={stopSource} data-testid="source-stop">
        {t('source.stop')}
      </Button>
    </Group>
  );
}

/** Returns the number of the call that is shown first: `update` of the selected block, or the first one. */
export function firstCall(calls: readonly SourceCall[], uid: number | null): number {
  const ofBlock = (call: SourceCall) => call.uid === uid;
  const isUpdate = (call: SourceCall) => call.function.endsWith('.update');
  const tests = [(call: SourceCall) => ofBlock(call) && isUpdate(call), ofBlock, isUpdate, () => true];
  for (const test of tests) {
    const found = calls.findIndex(test);
    if (found >= 0) return found;
  }
  return -1;
}

function Found({ source, uid }: { readonly source: TickSource; readonly uid: number | null }) {
  const { t } = useTranslation('axis');
  const [chosen, setChosen] = useState(() => firstCall(source.calls, uid));
  const call = source.calls[chosen];
  const notes = [
    source.differs === null ? '' : t('source.differs', { tick: source.differs }),
    source.left_out > 0 ? t('source.leftOut', { count: source.left_out }) : '',
    source.is_cut ? t('source.cut') : '',
    call && uid !== null && !source.calls.some((each) => each.uid === uid) ? t('source.notOfBlock') : '',
  ].filter(Boolean);
  return (
    <>
      {notes.map((note) => (
        <p key={note} className={classes['warning']} role="note">
          {note}
        </p>
      ))}
      {call ? (
        <>
          <NativeSelect
            size="xs"
            className={classes['calls'] ?? ''}
            aria-label={t('source.call')}
            value={String(chosen)}
            data={source.calls.map((each, at) => ({ value: String(at), label: nameOf(each, t) }))}
            onChange={({ currentTarget }) => setChosen(Number(currentTarget.value))}
            data-testid="source-call"
          />
          <div className={classes['parts']}>
            <RanCode source={source} call={call} />
            <CallValues call={call} />
          </div>
        </>
      ) : (
        <p className={classes['note']}>{t('source.nothing')}</p>
      )}
    </>
  );
}

type Words = (key: 'source.callback' | 'source.ofBlock', options: Record<string, string>) => string;

function nameOf({ function: name, path, part }: SourceCall, t: Words): string {
  const named = path === '' ? name : t('source.ofBlock', { name, path });
  return part === 'callback' ? t('source.callback', { name: named }) : named;
}
