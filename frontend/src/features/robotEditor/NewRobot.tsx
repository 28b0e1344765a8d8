import { Loader } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { CopyDialog } from '@/features/editor3d/CopyDialog';
import { CopyForm } from '@/features/editor3d/CopyForm';
import { FromFile } from '@/features/editor3d/FromFile';
import { takenRobots } from '@/features/universe/freeNames';
import { titled } from '@/features/universe/titles';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import { closeNewRobot, TEMPLATE, useNewRobot } from '@/store/dialogs/newRobot';

/** The dialogue that adds a robot to the project: a copy of the template or of a built-in robot. */
export function NewRobot() {
  const { t } = useTranslation('robotEditor');
  const base = useNewRobot((state) => state.base);
  return (
    <CopyDialog title={t('new.title')} isOpen={base !== null} onClose={closeNewRobot}>
      <FromFile kind="robot" onLeave={closeNewRobot} />
      <Form first={base ?? ''} />
    </CopyDialog>
  );
}

async function create(base: string, name: string, isUsed: boolean): Promise<void> {
  const { copyRobot } = await import('@/features/universe/copying');
  const path = await copyRobot(base, name);
  if (isUsed) useProjectStore.getState().setSettings({ robot: name });
  closeNewRobot();
  openFile(path);
}

function Form({ first }: { readonly first: string }) {
  const { t } = useTranslation('robotEditor');
  const { t: title } = useTranslation('worlds');
  const files = useProjectStore((state) => state.files);
  const robots = useQuery({ queryKey: ['robots'], queryFn: api.robots, staleTime: Infinity });
  const taken = takenRobots(Object.keys(files));
  if (robots.isPending) return <Loader size="sm" role="status" aria-label={t('new.loading')} />;
  return (
    <CopyForm
      items={[
        { id: TEMPLATE, name: t('new.template'), description: t('new.templateHint') },
        ...(robots.data ?? []).map((info) => titled(title, 'robot', info)),
      ]}
      first={first}
      taken={taken}
      words={{ hint: t('new.hint'), taken: t('new.taken'), use: t('new.use') }}
      testId="new-robot"
      onCreate={create}
      onCancel={closeNewRobot}
    />
  );
}
