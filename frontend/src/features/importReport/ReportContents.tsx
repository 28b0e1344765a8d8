import { Badge, Button, Group, ScrollArea, Stack, Text, UnstyledButton } from '@mantine/core';
import { IconAlertTriangle, IconCircleCheck, IconPencil, IconWorld } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { closeImportReport, useImportReport } from '@/store/dialogs/importReport';
import { openUniverseChooser } from '@/store/dialogs/universeChooser';
import { useProjectStore } from '@/store/project';
import { openAction } from '@/store/project/navigation';
import type { ListedProblem } from '@/store/problems/list';
import { openProblem } from '@/store/problems/open';
import { useProblems } from '@/store/problems/useProblems';
import { useProblemText } from '@/ui/useProblemText';
import classes from './importReport.module.css';

/**
 * The code of a finding that an action is still the stub which the import made; it is at a block of this
 * action.
 */
const STUB = 'BT0613';
/** The number of findings that are shown; the Problems panel lists all. */
const SHOWN = 8;

/** Returns the action that the user must still write, if the finding is a stub. */
function stubOf({ code, problem }: ListedProblem): string | undefined {
  return code === STUB && problem.source === 'server' ? problem.values?.['name'] : undefined;
}

/** Closes the report and opens the place of a finding; for a stub, the source to be written. */
function look(row: ListedProblem): void {
  closeImportReport();
  const stub = stubOf(row);
  if (stub === undefined) openProblem(row);
  else openAction(stub);
}

export function ReportContents() {
  const { t } = useTranslation('importReport');
  const files = useProjectStore((state) => state.files);
  const universe = useProjectStore((state) => state.settings?.universe ?? '');
  const proposal = useImportReport((state) => state.proposal);
  const problems = useProblems().filter(({ severity }) => severity !== 'note');
  const stubs = problems.filter(({ code }) => code === STUB);
  const others = problems.filter(({ code }) => code !== STUB);
  const first = others[0] ?? stubs[0];
  const paths = Object.keys(files);
  const trees = paths.filter((path) => files[path]?.kind === 'tree').length;
  const actions = paths.filter((path) => /^actions\/[^/]+\.py$/.test(path)).length;
  const choose = () => {
    closeImportReport();
    openUniverseChooser();
  };
  return (
    <Stack gap="md" data-testid="import-report">
      <Group gap="sm" aria-label={t('came')} role="group">
        <Badge variant="light" tt="none">
          {t('trees', { count: trees })}
        </Badge>
        <Badge variant="light" tt="none">
          {t('actions', { count: actions })}
        </Badge>
        <Badge variant="light" color="gray" tt="none">
          {t('others', { count: paths.length - trees - actions })}
        </Badge>
      </Group>
      {problems.length === 0 ? (
        <Group gap="sm">
          <IconCircleCheck size={18} aria-hidden="true" />
          <Text size="sm">{t('fine')}</Text>
        </Group>
      ) : null}
      <ScrollArea.Autosize mah="45vh">
        <Rows heading={t('problems', { count: others.length })} rows={others} />
        <Rows heading={t('stubs')} rows={stubs} />
      </ScrollArea.Autosize>
      <Group gap="sm" wrap="nowrap">
        <IconWorld size={18} className={classes['icon'] ?? ''} aria-hidden="true" />
        <Text size="sm" className={classes['universe'] ?? ''}>
          {t('universe', { name: t(`worlds:universe.${universe}.name`, { defaultValue: universe }) })}{' '}
          {proposal?.universe === universe ? (
            <span data-testid="import-reason">{t(`reason.${universe}`, { topics: proposal.topics })}</span>
          ) : null}
        </Text>
        <Button size="compact-sm" variant="default" onClick={choose}>
          {t('choose')}
        </Button>
      </Group>
      <Group justify="end">
        {first ? (
          <Button variant="default" onClick={() => look(first)} data-testid="open-first-problem">
            {t('openFirst')}
          </Button>
        ) : null}
        <Button onClick={closeImportReport} data-autofocus>
          {t('done')}
        </Button>
      </Group>
    </Stack>
  );
}

function Rows({ heading, rows }: { readonly heading: string; readonly rows: readonly ListedProblem[] }) {
  const { t } = useTranslation('importReport');
  if (rows.length === 0) return null;
  return (
    <section className={classes['part']}>
      <h3 className={classes['heading']}>{heading}</h3>
      <ul className={classes['rows']}>
        {rows.slice(0, SHOWN).map((row, index) => (
          <li key={`${row.code}-${index}`}>
            <Row row={row} />
          </li>
        ))}
      </ul>
      {rows.length > SHOWN ? (
        <Text size="xs" c="dimmed">
          {t('more', { count: rows.length - SHOWN })}
        </Text>
      ) : null}
    </section>
  );
}

function Row({ row }: { readonly row: ListedProblem }) {
  const { t } = useTranslation('importReport');
  const { message, hint } = useProblemText()(row.problem);
  const stub = stubOf(row);
  const family = useProjectStore((state) => stub && state.vocabulary.specs.get(stub)?.family);
  const Icon = stub ? IconPencil : IconAlertTriangle;
  return (
    <UnstyledButton className={classes['row']} data-severity={row.severity} onClick={() => look(row)}>
      <Icon size={16} aria-hidden="true" />
      {stub ? (
        <span>
          <strong>{stub}</strong> <span className={classes['hint']}>{t(`kind.${family ?? 'action'}`)}</span>
        </span>
      ) : (
        <span>
          {message} <span className={classes['hint']}>{hint}</span>
        </span>
      )}
    </UnstyledButton>
  );
}
