import { ActionIcon, NativeSelect, Table } from '@mantine/core';
import { IconX } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { comparableRuns, compareWith, endComparing, useComparing } from '@/store/moment/compare/comparing';
import type { Difference, StatusThere } from '@/store/moment/compare/differences';
import { labelOf } from '@/store/moment/compare/runNames';
import { extent, lookAt } from '@/store/moment/looking';
import { useMoment } from '@/store/moment/store';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { cssOf, hueOf } from '@/store/session/trace/shownPaths';
import classes from '../axis.module.css';

/** The shown run beside another one, at the moment at which the user looks: the blocks whose status differs. */
export function Compared() {
  const { t } = useTranslation('axis');
  const { other, partedAt, otherEnd, state, rows, failure } = useComparing();
  const segments = useSessionStore((session) => session.segments);
  const branches = useSessionStore((session) => session.branches);
  const moment = useMoment((now) => now.shown?.t ?? null);
  if (other === null) return null;
  const name = (run: string) => labelOf(run, { segments, branches });
  const note =
    failure !== ''
      ? failure
      : state === 'shown'
        ? rows.length === 0
          ? t('compared.same')
          : ''
        : t(`compared.${state}`, { parted: partedAt.toFixed(2), end: otherEnd.toFixed(2) });
  return (
    <section className={classes['changes']} aria-label={t('compared.label')} data-testid="axis-compared">
      <header className={classes['comparedHead']}>
        <strong>{t('compared.title', { t: moment?.toFixed(2) ?? '–' })}</strong>
        <span className={classes['side']}>
          <Sign number={1} /> {name(extent()?.run ?? '')}
        </span>
        <span className={classes['side']}>
          <Sign number={2} />
          <NativeSelect
            size="xs"
            aria-label={t('compared.with')}
            value={other}
            data={comparableRuns().map((value) => ({ value, label: name(value) }))}
            onChange={({ currentTarget }) => compareWith(currentTarget.value)}
            data-testid="compared-with"
          />
        </span>
        <button type="button" className={classes['toParted']} onClick={() => lookAt(partedAt)}>
          {t('compared.parted', { t: partedAt.toFixed(2) })}
        </button>
        <ActionIcon
          size="sm"
          aria-label={t('compared.end')}
          onClick={endComparing}
          data-testid="compared-end"
        >
          <IconX size={14} />
        </ActionIcon>
      </header>
      {note === '' ? (
        <Rows rows={rows} />
      ) : (
        <p className={classes['changesNote']} role="status">
          {note}
        </p>
      )}
    </section>
  );
}

/** The number of a side, with the colour and the dashes of its path. */
function Sign({ number }: { readonly number: 1 | 2 }) {
  return (
    <>
      <span
        className={classes['sideSign']}
        style={{ borderColor: cssOf(hueOf(number)) }}
        data-dashed={number === 2 || undefined}
        aria-hidden="true"
      />
      <strong>{number}</strong>
    </>
  );
}

function Rows({ rows }: { readonly rows: readonly Difference[] }) {
  const { t } = useTranslation('axis');
  return (
    <Table fz="sm" verticalSpacing={2} className={classes['comparedTable'] ?? ''}>
      <Table.Thead>
        <Table.Tr>
          <Table.Th>{t('compared.block')}</Table.Th>
          <Table.Th>
            <Sign number={1} />
          </Table.Th>
          <Table.Th>
            <Sign number={2} />
          </Table.Th>
        </Table.Tr>
      </Table.Thead>
      <Table.Tbody>
        {rows.map(({ id, tree, node, path, here, there }) => (
          <Table.Tr key={id} data-testid="compared-row">
            <Table.Td>
              <button
                type="button"
                className={classes['change']}
                onClick={() => useProjectStore.getState().reveal(tree, node)}
              >
                {path}
              </button>
            </Table.Td>
            <Table.Td>
              <Status status={here} />
            </Table.Td>
            <Table.Td>
              <Status status={there} />
            </Table.Td>
          </Table.Tr>
        ))}
      </Table.Tbody>
    </Table>
  );
}

function Status({ status }: { readonly status: StatusThere }) {
  const { t } = useTranslation(['axis', 'run']);
  return (
    <span className={classes['comparedStatus']} data-status={status ?? undefined}>
      {status === null ? t('compared.absent') : t(`run:status.${status}`)}
    </span>
  );
}
