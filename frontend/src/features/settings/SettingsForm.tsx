import { Button, Group, Radio, Select, Stack, Textarea, TextInput } from '@mantine/core';
import { useState, type FormEvent } from 'react';
import { useTranslation } from 'react-i18next';
import type { ProjectSettings } from '@/api/types';
import { ROS_DISTROS, titled, type RosDistro } from '@/model/rosDistros';
import { changeDistribution, distributionOf, type Left } from '@/store/project/edits/distribution';
import { undoNotification } from '@/ui/undoNotification';
import { DEFAULT_TICK_HZ, RUN_TIMES, TICK_RATES } from '@/features/run/rates';
import { LIMITS } from '@/generated/limits';
import { useProjectStore } from '@/store/project';
import { setTickRate } from '@/store/run/commands';
import { projectNameProblem } from './names';
import { closeSettings } from '@/store/dialogs/settings';

const FINISHES = ['stop', 'repeat'] as const;
const ERRORS = ['stop', 'failure'] as const;

interface ChoiceProps {
  readonly label: string;
  readonly value: string;
  readonly options: readonly { readonly value: string; readonly label: string }[];
  readonly onChange: (value: string) => void;
}

function Choice({ label, value, options, onChange }: ChoiceProps) {
  return (
    <Radio.Group label={label} value={value} onChange={onChange}>
      <Group gap="lg" mt={6}>
        {options.map((option) => (
          <Radio key={option.value} value={option.value} label={option.label} />
        ))}
      </Group>
    </Radio.Group>
  );
}

export function SettingsForm() {
  const { t } = useTranslation('settings');
  const kept = useProjectStore((state) => state.settings);
  const isReadOnly = useProjectStore((state) => state.role === 'viewer');
  const trees = useProjectStore((state) => state.diagrams);
  const found = useProjectStore(distributionOf);
  const [refused, setRefused] = useState<string | null>(null);
  const [isChanging, setChanging] = useState(false);
  const [form, setForm] = useState<Partial<ProjectSettings>>({});
  if (!kept) return null;
  const now = { ...kept, ...form };
  const set = (part: Partial<ProjectSettings>) => setForm((before) => ({ ...before, ...part }));
  const problem = projectNameProblem(now.name);
  const distribution = form.ros_distro ?? found;
  const hz = now.tick_hz ?? DEFAULT_TICK_HZ;
  const rates = [...new Set<number>([...TICK_RATES, hz])].sort((a, b) => a - b);

  const submit = (event: FormEvent) => {
    event.preventDefault();
    if (problem) return;
    // Only the fields that were changed here are saved, since another user may have changed the others.
    const { tick_hz, ros_distro, ...others } = form;
    if (others.name !== undefined) others.name = others.name.trim();
    if (Object.keys(others).length > 0) useProjectStore.getState().setSettings(others);
    if (tick_hz !== undefined && tick_hz !== kept.tick_hz) setTickRate(tick_hz);
    if (ros_distro === undefined || ros_distro === kept.ros_distro) closeSettings();
    else void toDistribution(ros_distro);
  };

  const toDistribution = async (name: RosDistro) => {
    setChanging(true);
    try {
      const left = await changeDistribution(name);
      closeSettings();
      if (left) tellChanged(name, left);
    } catch (error) {
      setRefused(error instanceof Error ? error.message : String(error));
    } finally {
      setChanging(false);
    }
  };

  const tellChanged = (name: RosDistro, { lacks, kept: own }: Left) => {
    const parts = [
      t('changed', { name: titled(name) }),
      lacks.length > 0 ? t('lacks', { name: titled(name), list: lacks.join(', ') }) : '',
      own.length > 0 ? t('keptCode', { list: own.join(', ') }) : '',
    ];
    const { undo } = useProjectStore.getState();
    undoNotification({ message: parts.filter(Boolean).join(' '), undoLabel: t('undo'), undo: () => undo() });
  };

  return (
    <form onSubmit={submit} data-testid="settings">
      <Stack gap="md">
        <TextInput
          data-autofocus
          label={t('name')}
          value={now.name}
          error={problem ? t(`problem.${problem}`) : null}
          disabled={isReadOnly}
          onChange={(event) => set({ name: event.currentTarget.value })}
        />
        <Textarea
          label={t('description')}
          autosize
          minRows={2}
          maxRows={6}
          maxLength={LIMITS.description_characters}
          value={now.description ?? ''}
          disabled={isReadOnly}
          onChange={(event) => set({ description: event.currentTarget.value })}
        />
        <Group grow align="start">
          <Select
            label={t('mainTree')}
            data={Object.keys(trees)}
            value={now.main_tree}
            allowDeselect={false}
            disabled={isReadOnly}
            onChange={(main_tree) => main_tree !== null && set({ main_tree })}
          />
          <Select
            label={t('tickRate')}
            data={rates.map((rate) => ({ value: String(rate), label: `${rate} Hz` }))}
            value={String(hz)}
            allowDeselect={false}
            disabled={isReadOnly}
            onChange={(rate) => set({ tick_hz: Number(rate) })}
          />
        </Group>
        <Select
          label={t('distribution')}
          description={t(kept.ros_distro === undefined ? 'distributionFound' : 'distributionHelp', {
            name: titled(found),
          })}
          data={ROS_DISTROS.map((value) => ({ value, label: titled(value) }))}
          value={distribution}
          error={refused}
          allowDeselect={false}
          disabled={isReadOnly}
          onChange={(value) => {
            const ros_distro = ROS_DISTROS.find((each) => each === value);
            if (ros_distro) set({ ros_distro });
          }}
        />
        <fieldset disabled={isReadOnly} style={{ border: 0, margin: 0, padding: 0, minWidth: 0 }}>
          <Stack gap="md">
            <Choice
              label={t('onFinish')}
              value={now.on_finish ?? 'stop'}
              options={FINISHES.map((value) => ({ value, label: t(`finish.${value}`) }))}
              onChange={(value) => set({ on_finish: value === 'repeat' ? 'repeat' : 'stop' })}
            />
            <Choice
              label={t('onError')}
              value={now.on_error ?? 'stop'}
              options={ERRORS.map((value) => ({ value, label: t(`error.${value}`) }))}
              onChange={(value) => set({ on_error: value === 'failure' ? 'failure' : 'stop' })}
            />
            <Choice
              label={t('time')}
              value={now.time ?? 'live'}
              options={RUN_TIMES.map((value) => ({ value, label: t(`times.${value}`) }))}
              onChange={(value) => set({ time: value === 'exact' ? 'exact' : 'live' })}
            />
          </Stack>
        </fieldset>
        <Group justify="flex-end">
          <Button variant="default" onClick={closeSettings}>
            {t('cancel')}
          </Button>
          <Button type="submit" loading={isChanging} disabled={isReadOnly || problem !== null}>
            {t('save')}
          </Button>
        </Group>
      </Stack>
    </form>
  );
}
