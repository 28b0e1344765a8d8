import { Loader } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { CopyDialog } from '@/features/editor3d/CopyDialog';
import { CopyForm } from '@/features/editor3d/CopyForm';
import { FromFile } from '@/features/editor3d/FromFile';
import { takenUniverses } from '@/features/universe/freeNames';
import { OUTSIDE, titled } from '@/features/universe/titles';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import { closeNewUniverse, useNewUniverse } from '@/store/dialogs/newUniverse';

/** The dialogue that adds a universe to the project: a copy of a built-in one. */
export function NewUniverse() {
  const { t } = useTranslation('universeEditor');
  const base = useNewUniverse((state) => state.base);
  return (
    <CopyDialog title={t('new.title')} isOpen={base !== null} onClose={closeNewUniverse}>
      <FromFile kind="universe" onLeave={closeNewUniverse} />
      <Form first={base ?? ''} />
    </CopyDialog>
  );
}

async function create(base: string, name: string, isUsed: boolean): Promise<void> {
  const { copyUniverse } = await import('@/features/universe/copying');
  const path = await copyUniverse(base, name);
  if (isUsed) useProjectStore.getState().setSettings({ universe: name });
  closeNewUniverse();
  openFile(path);
}

function Form({ first }: { readonly first: string }) {
  const { t } = useTranslation('universeEditor');
  const { t: title } = useTranslation('worlds');
  const files = useProjectStore((state) => state.files);
  const universes = useQuery({ queryKey: ['universes'], queryFn: api.universes, staleTime: Infinity });
  const taken = takenUniverses(Object.keys(files));
  const shipped = (universes.data ?? []).filter(({ id }) => id !== OUTSIDE);
  if (universes.isPending) return <Loader size="sm" role="status" aria-label={t('new.loading')} />;
  return (
    <CopyForm
      items={shipped.map((info) => titled(title, 'universe', info))}
      first={first}
      taken={taken}
      words={{ hint: t('new.hint'), taken: t('new.taken'), use: t('new.use') }}
      testId="new-universe"
      onCreate={create}
      onCancel={closeNewUniverse}
    />
  );
}
