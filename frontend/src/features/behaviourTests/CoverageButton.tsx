import { Button } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { IconPercentage60 } from '@tabler/icons-react';
import { useMutation } from '@tanstack/react-query';
import { useTranslation } from 'react-i18next';
import { evaluations, type Evaluation, type EvaluationSide } from '@/api/evaluations';
import { refusalText } from '@/i18n/evaluationReasons';
import { showEvaluated } from '@/store/behaviourTests/coverage';
import { useProjectStore } from '@/store/project';

interface Props {
  readonly projectId: string;
  readonly evaluation: Evaluation;
  readonly side: EvaluationSide;
}

/** Shows on the canvas which blocks the runs ticked, and which results these had. */
export function CoverageButton({ projectId, evaluation, side }: Props) {
  const { t } = useTranslation('evaluate');
  const { revision, done } = side;
  const asking = useMutation({
    mutationFn: () => evaluations.coverage(projectId, evaluation.id, revision),
    onSuccess: (coverage) => {
      if (useProjectStore.getState().projectId !== projectId) return;
      showEvaluated({ name: evaluation.name, revision, runs: done, coverage });
    },
    onError: (error) =>
      notifications.show({ color: 'red', message: t('coverage.failed', { reason: refusalText(t, error) }) }),
  });
  return (
    <Button
      size="compact-xs"
      variant="subtle"
      leftSection={<IconPercentage60 size={14} aria-hidden="true" />}
      loading={asking.isPending}
      onClick={() => asking.mutate()}
    >
      {t('coverage.show')}
    </Button>
  );
}
