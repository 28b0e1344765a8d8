import { Button, Checkbox, Group, Table, Text } from '@mantine/core';
import { IconCube } from '@tabler/icons-react';
import { type ReactNode, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { TryOutcome } from '@/generated/messages';
import { canUse, drawTries, openAsBranch, writeValue } from '@/store/moment/rerun/tryMany';
import { choosePath, useTries, type TriesJob } from '@/store/session/tries';
import { showPanel } from '@/workspace/tabs';
import { cssOf, hueOf } from '@/store/session/trace/shownPaths';
import { useBlockNames } from './blockNames';
import { TryPlan } from './TryPlan';
import classes from './tries.module.css';

/** What came of each value: a table, and the paths of the robots from above. */
export function TryResults() {
  const { t } = useTranslation('axis');
  const nameOf = useBlockNames();
  const job = useTries((state) => state.job);
  if (job === null || job.started === null) return null;
  const { place, hidden, outcomes } = job;
  const moment = job.moment.t.toFixed(2);
  const drawn = outcomes.filter(
    ({ index, paths }) => Object.keys(paths).length > 0 && !hidden.includes(index),
  );
  return (
    <section className={classes['results']} data-testid="tries-results">
      <Text size="sm" fw={600}>
        {place
          ? t('tries.results', { port: place.port, path: nameOf(place.path), t: moment })
          : t('tries.seedResults', { t: moment })}
      </Text>
      {drawn.length > 0 ? (
        <Button
          size="compact-sm"
          variant="default"
          w="fit-content"
          leftSection={<IconCube size={14} />}
          onClick={() => {
            drawTries(job);
            showPanel('viewer3d');
          }}
          data-testid="tries-3d"
        >
          {t('tries.in3d', { count: drawn.length })}
        </Button>
      ) : null}
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
  // The roles stay where the cells are shown as a list, in a narrow window.
  return (
    <Table fz="xs" verticalSpacing={4} role="table" className={classes['rows'] ?? ''}>
      <Table.Thead role="rowgroup">
        <Table.Tr role="row">
          {columnsOf(job).map((each) => (
            <Table.Th key={each} role="columnheader">
              {t(`tries.column.${each}`)}
            </Table.Th>
          ))}
        </Table.Tr>
      </Table.Thead>
      <Table.Tbody role="rowgroup">
        {[null, ...job.values].map((value, index) => (
          <Row key={index} job={job} index={index} value={value} />
        ))}
      </Table.Tbody>
    </Table>
  );
}

const columnsOf = ({ place }: TriesJob) =>
  ['number', place ? 'value' : 'seed', 'end', 'crash', 'distance', 'nodes', 'actions'] as const;

interface RowProps {
  readonly job: TriesJob;
  readonly index: number;
  readonly value: string | null;
}

function Row({ job, index, value }: RowProps) {
  const { t } = useTranslation('axis');
  const nameOf = useBlockNames();
  const outcome = job.outcomes.find((each) => each.index === index);
  const did = outcome !== undefined && outcome.ticks > 0;
  const cells: Record<string, ReactNode> = {
    number: (
      <span className={classes['name']}>
        <Checkbox
          size="md"
          aria-label={t('tries.choose', { number: index })}
          checked={did && !job.hidden.includes(index)}
          disabled={!did}
          onChange={({ currentTarget }) => choosePath(index, currentTarget.checked)}
          data-testid={`tries-choose-${index}`}
        />
        <span className={classes['swatch']} style={{ background: cssOf(hueOf(index)) }} aria-hidden="true" />
        {index}
      </span>
    ),
    value: value ?? t('tries.asItIs'),
    seed: value ?? t('tries.asItIs'),
    end: outcome ? <End outcome={outcome} job={job} /> : job.ended ? '–' : t('tries.waiting'),
    crash: did ? <FirstCrash outcome={outcome} /> : '–',
    distance: did ? `${outcome.distance_m.toFixed(2)} m` : '–',
    nodes: outcome?.nodes.map(nameOf).join(', ') || '–',
    actions: did ? <Actions job={job} index={index} value={value} /> : null,
  };
  return (
    <Table.Tr role="row" data-testid={`tries-row-${index}`}>
      {columnsOf(job).map((each) => (
        <Table.Td key={each} role="cell" data-label={t(`tries.column.${each}`)}>
          {cells[each]}
        </Table.Td>
      ))}
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
      {outcome.end !== 'running' && outcome.ticks > 0
        ? ` ${t('tries.after', { t: (outcome.t - job.moment.t).toFixed(2) })}`
        : ''}
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
  const { place } = job;
  // A run of the session has one seed: what another one did cannot be opened.
  if (place === null && value !== null) return '–';
  return (
    <Group gap={4}>
      <Button
        size="compact-xs"
        variant="default"
        aria-label={t('tries.branchOf', { number: index })}
        onClick={() => void openAsBranch(job, value)}
        data-testid={`tries-branch-${index}`}
      >
        {t('tries.branch')}
      </Button>
      {value !== null && place !== null && canUse(place) ? (
        <Button
          size="compact-xs"
          variant="default"
          aria-label={t('tries.useOf', { value })}
          onClick={() => {
            writeValue(place, value);
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
