import { ActionIcon, Button, Group, Menu } from '@mantine/core';
import { IconDots, IconDownload } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { evaluations, type Evaluation } from '@/api/evaluations';
import { CompareForm } from './CompareForm';
import { isLive } from './useEvaluations';

interface Props {
  readonly projectId: string;
  readonly evaluation: Evaluation;
  /** The revision that was evaluated before, with which it is compared at first. */
  readonly earlier: number | null;
  readonly mayStart: boolean;
  readonly onCancel: () => void;
  readonly onResume: () => void;
  readonly onCompare: (revision: number) => void;
  readonly onRemove: () => void;
}

/** What can be done with an evaluation. */
export function EvaluationActions({
  projectId,
  evaluation,
  earlier,
  mayStart,
  onCancel,
  onResume,
  onCompare,
  onRemove,
}: Props) {
  const { t } = useTranslation('evaluate');
  const [mode, setMode] = useState<'shown' | 'compared' | 'removed'>('shown');
  const live = isLive(evaluation);
  const done = evaluation.sides[0]?.done ?? 0;
  const isWhole = evaluation.state === 'done' && !hasUncounted(evaluation);
  const back = () => setMode('shown');
  if (mode === 'compared' && !live) {
    return (
      <CompareForm
        projectId={projectId}
        before={evaluation.revision}
        suggested={earlier}
        onCancel={back}
        onCompare={(revision) => {
          back();
          onCompare(revision);
        }}
      />
    );
  }
  if (mode === 'removed') {
    return (
      <Group gap="xs" role="alert">
        <span>{t('remove.sure')}</span>
        <Button ref={focus} size="compact-xs" variant="default" onClick={back}>
          {t('remove.keep')}
        </Button>
        <Button size="compact-xs" variant="light" color="red" onClick={onRemove}>
          {t('remove.do')}
        </Button>
      </Group>
    );
  }
  return (
    <Group gap={6}>
      {mayStart && live ? (
        <Button size="compact-xs" variant="default" onClick={onCancel}>
          {t('cancel')}
        </Button>
      ) : null}
      {mayStart && !live && !isWhole ? (
        <Button size="compact-xs" variant="light" onClick={onResume}>
          {t('resume')}
        </Button>
      ) : null}
      {mayStart && !live && done > 0 && evaluation.revision > 1 ? (
        <Button size="compact-xs" variant="light" onClick={() => setMode('compared')}>
          {t('compare.open')}
        </Button>
      ) : null}
      {done > 0 ? (
        <ActionIcon
          component="a"
          href={evaluations.reportUrl(projectId, evaluation.id)}
          download
          size={26}
          variant="subtle"
          aria-label={t('export.report')}
          title={t('export.report')}
        >
          <IconDownload size={16} />
        </ActionIcon>
      ) : null}
      <Menu position="bottom-end" width={230}>
        <Menu.Target>
          <ActionIcon size={26} variant="subtle" aria-label={t('more')}>
            <IconDots size={16} />
          </ActionIcon>
        </Menu.Target>
        <Menu.Dropdown>
          {evaluation.sides
            .filter((side) => side.done > 0)
            .map((side) => (
              <Menu.Item
                key={side.revision}
                component="a"
                href={evaluations.linesUrl(projectId, evaluation.id, side.revision)}
                download
              >
                {t('export.lines', { revision: side.revision })}
              </Menu.Item>
            ))}
          {mayStart ? (
            <Menu.Item color="red" onClick={() => setMode('removed')}>
              {t('remove.do')}
            </Menu.Item>
          ) : null}
        </Menu.Dropdown>
      </Menu>
    </Group>
  );
}

/** The menu that asked is gone: the focus goes to its question. */
const focus = (element: HTMLButtonElement | null) => element?.focus();

/** Returns whether some runs said nothing of the project, so that they can be run again. */
const hasUncounted = ({ sides }: Evaluation): boolean =>
  sides.some(
    ({ counts }) => (counts['invalid'] ?? 0) + (counts['lost'] ?? 0) + (counts['cancelled'] ?? 0) > 0,
  );
