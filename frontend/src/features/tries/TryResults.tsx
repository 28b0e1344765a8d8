import { Button, Group, Table, Text } from '@mantine/core';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { TryOutcome } from '@/generated/messages';
import { canUse, openAsBranch, writeValue } from '@/store/moment/rerun/tryMany';
import { useTries, type TriesJob } from '@/store/session/tries';
import { cssOf, hueOf } from '@/store/session/trace/shownPaths';
import { TryPlan } from './TryPlan';
import classes from './tries.module.css';

/** What came of each value: a table, and the paths of the robots from above. */
export function TryResults() {
  const { t } = useTranslation('axis');
  const job = useTries((state) => state.job);
  if (job === null || job.started === null) return null;
  const { path, port, t: moment } = job.place;
  return (
    <section className={classes['results']} data-testid="tries-results">
      <Text size="sm" fw={600}>
        {t('tries.results', { port, path, t: moment.toFixed(2) })}
      </Text>
      <div className={classes['parts']}>
        <div className={classes['table']}>
          <Rows job={job} />
        </div>
        <TryPlan outlines={job.started.outlines} outcomes={job.outcomes} />
      </div>
    </section>
  );
}

function Rows({ job }: { readonly job: TriesJob }) {
  const { t } = useTranslation('axis');
  const columns = ['number', 'value', 'end', 'crash', 'distance', 'nodes', 'actions'] as const;
  return (
    <Table fz="xs" verticalSpacing={4}>
      <Table.Thead>
        <Table.Tr>
          {columns.map((each) => (
            <Table.Th key={each}>{t(`tries.column.${each}`)}</Table.Th>
          ))}
        </Table.Tr>
      </Table.Thead>
      <Table.Tbody>
        {[null, ...job.values].map((value, index) => (
          <Row key={index} job={job} index={index} value={value} />
        ))}
      </Table.Tbody>
    </Table>
  );
}

interface RowProps {
  readonly job: TriesJob;
  readonly index: number;
  readonly value: string | null;
}

function Row({ job, index, value }: RowProps) {
  const { t } = useTranslation('axis');
  const outcome = job.outcomes.find((each) => each.index === index);
  const did = outcome !== undefined && outcome.ticks > 0;
  return (
    <Table.Tr data-testid={`tries-row-${index}`}>
      <Table.Td className={classes['name']}>
        <span className={classes['swatch']} style={{ background: cssOf(hueOf(index)) }} aria-hidden="true" />{' '}
        {index}
      </Table.Td>
      <Table.Td>{value ?? t('tries.asItIs')}</Table.Td>
      <Table.Td>
        {outcome ? <End outcome={outcome} job={job} /> : job.ended ? '–' : t('tries.waiting')}
      </Table.Td>
      <Table.Td>{did ? <FirstCrash outcome={outcome} /> : '–'}</Table.Td>
      <Table.Td>{did ? `${outcome.distance_m.toFixed(2)} m` : '–'}</Table.Td>
      <Table.Td>{outcome?.nodes.join(', ') || '–'}</Table.Td>
      <Table.Td>{did ? <Actions job={job} index={index} value={value} /> : null}</Table.Td>
    </Table.Tr>
  );
}

function End({ outcome, job }: { readonly outcome: TryOutcome; readonly job: TriesJob }) {
  const { t } = useTranslation('axis');
  const same = job.outcomes.find(
    ({ index, fingerprint }) => index < outcome.index && fingerprint === outcome.fingerprint,
  );
  const notes = [
    outcome.as_before === true ? t('tries.asBefore') : '',
    same && outcome.ticks > 0 ? t('tries.same', { number: same.index }) : '',
  ].filter(Boolean);
  return (
    <span title={outcome.message}>
      {t(`tries.end.${outcome.end}`, { root: outcome.root })}
      {notes.length > 0 ? <span className={classes['note']}> ({notes.join('; ')})</span> : null}
      {['refused', 'fault', 'died'].includes(outcome.end) ? (
        <span className={classes['message']}>{outcome.message}</span>
      ) : null}
    </span>
  );
}

function FirstCrash({ outcome: { crash, collisions } }: { readonly outcome: TryOutcome }) {
  const { t } = useTranslation('axis');
  if (crash === null) return t('tries.noCrash');
  return (
    <span className={classes['crash']}>
      {t('tries.crash', { t: crash.t.toFixed(2), body: crash.body })}
      {collisions > 1 ? t('tries.more', { count: collisions - 1 }) : ''}
    </span>
  );
}

function Actions({ job, index, value }: RowProps) {
  const { t } = useTranslation('axis');
  const [isUsed, setIsUsed] = useState(false);
  return (
    <Group gap={4} wrap="nowrap">
      <Button
        size="compact-xs"
        variant="default"
        aria-label={t('tries.branchOf', { number: index })}
        onClick={() => void openAsBranch(job.place, value)}
        data-testid={`tries-branch-${index}`}
      >
        {t('tries.branch')}
      </Button>
      {value !== null && canUse(job.place) ? (
        <Button
          size="compact-xs"
          variant="default"
          aria-label={t('tries.useOf', { value })}
          onClick={() => {
            writeValue(job.place, value);
            setIsUsed(true);
          }}
          data-testid={`tries-use-${index}`}
        >
          {t('tries.use')}
        </Button>
      ) : null}
      {isUsed ? <span role="status">{t('tries.used')}</span> : null}
    </Group>
  );
}
