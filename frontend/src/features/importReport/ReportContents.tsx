import { Badge, Button, Group, Stack, Text } from '@mantine/core';
import { IconAlertTriangle, IconCircleCheck, IconPencil, IconWorld } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { closeImportReport, useImportReport } from '@/store/dialogs/importReport';
import { openUniverseChooser } from '@/store/dialogs/universeChooser';
import { useProjectStore } from '@/store/project';
import { openAction } from '@/store/project/navigation';
import type { ListedProblem } from '@/store/problems/list';
import { openProblem } from '@/store/problems/open';
import { useProblems } from '@/store/problems/useProblems';
import { useProblemText } from '@/ui/hooks/useProblemText';
import classes from './importReport.module.css';
import { ReportSections, type ReportRow } from './ReportSections';

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
  const oneBlock = useImportReport((state) => state.oneBlock);
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
  const row = useRow();
  const most = { count: SHOWN, more: (count: number) => t('more', { count }) };
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
      {oneBlock ? (
        <Text size="sm" data-testid="one-block">
          {t('oneBlock', { reason: oneBlock })}
        </Text>
      ) : null}
      {problems.length === 0 ? (
        <Group gap="sm">
          <IconCircleCheck size={18} aria-hidden="true" />
          <Text size="sm">{t('fine')}</Text>
        </Group>
      ) : null}
      <ReportSections
        parts={[
          { heading: t('problems', { count: others.length }), rows: others.map(row), most },
          { heading: t('stubs'), rows: stubs.map(row), most },
        ]}
      />
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

/** Returns how a finding is shown: a stub by the name of its action. */
function useRow(): (found: ListedProblem, index: number) => ReportRow {
  const { t } = useTranslation('importReport');
  const textOf = useProblemText();
  const specs = useProjectStore((state) => state.vocabulary.specs);
  return (found, index) => {
    const { message, hint } = textOf(found.problem);
    const stub = stubOf(found);
    const [main, more] =
      stub === undefined ? [message, hint] : [stub, t(`kind.${specs.get(stub)?.family ?? 'action'}`)];
    const Icon = stub === undefined ? IconAlertTriangle : IconPencil;
    return {
      key: `${found.code}-${index}`,
      text: more ? `${main} ${more}` : main,
      icon: <Icon size={16} aria-hidden="true" />,
      content: (
        <span>
          {stub === undefined ? main : <strong>{main}</strong>}{' '}
          <span className={classes['hint']}>{more}</span>
        </span>
      ),
      severity: found.severity,
      onOpen: () => look(found),
    };
  };
}
