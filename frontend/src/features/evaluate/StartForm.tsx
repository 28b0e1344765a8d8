import { Button, Checkbox, Group, NumberInput, Text } from '@mantine/core';
import { IconPlayerPlay } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { EvaluationList } from '@/api/evaluations';
import { evaluationPath } from '@/model/evaluation/files';
import { readForm } from '@/model/evaluation/form';
import { useProjectStore } from '@/store/project';
import { duration, short } from './outcomeText';

interface Props {
  readonly name: string;
  readonly costs: EvaluationList['costs'];
  readonly isStarting: boolean;
  readonly onStart: (runs: number, sealed: boolean) => void;
}

/** Starts an evaluation: with how many runs, sealed or not, and how long that will probably take. */
export function StartForm({ name, costs, isStarting, onStart }: Props) {
  const { t } = useTranslation('evaluate');
  const [runs, setRuns] = useState<number | null>(null);
  const [isSealed, setSealed] = useState(false);
  const inFile = useProjectStore((state) => readForm(state.files[evaluationPath(name)]?.text ?? '')?.runs);
  const wanted = runs ?? inFile ?? null;
  const cost = costs.find((each) => each.name === name);
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        onStart(runs ?? 0, isSealed);
      }}
    >
      <Group gap={6} align="flex-end" wrap="nowrap">
        <NumberInput
          size="xs"
          style={{ minWidth: 0 }}
          label={t('runs')}
          placeholder={t('runsAsFile')}
          min={1}
          max={10_000}
          allowDecimal={false}
          value={runs ?? ''}
          onChange={(value) => setRuns(typeof value === 'number' && value > 0 ? value : null)}
        />
        <Button
          type="submit"
          size="xs"
          style={{ flexShrink: 0 }}
          loading={isStarting}
          leftSection={<IconPlayerPlay size={14} aria-hidden="true" />}
        >
          {t('start')}
        </Button>
      </Group>
      <Checkbox
        size="xs"
        mt={6}
        label={t('sealed.choose')}
        description={t('sealed.what')}
        checked={isSealed}
        onChange={({ currentTarget: { checked } }) => setSealed(checked)}
      />
      <Text size="xs" c="dimmed" mt={6} role="note" data-testid="evaluation-estimate">
        {cost && wanted !== null
          ? t('estimate.about', {
              count: wanted,
              time: duration((wanted * cost.cpu_s) / cost.workers),
              each: short(cost.cpu_s),
            })
          : t('estimate.unknown')}
      </Text>
    </form>
  );
}
