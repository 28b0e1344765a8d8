import { notifications } from '@mantine/notifications';
import { useMutation } from '@tanstack/react-query';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { ApiError } from '@/api/errors';
import type { Diagnostic } from '@/api/types';
import { announceImport } from '@/store/dialogs/importReport';
import { navigate, projectPath } from '@/store/route';
import { reasonOf } from '@/api/reason';

/** The translator's code for a character that a repair would escape. */
const REPAIRABLE = 'BT0740';

/** A file that can be imported after a repair, with the changes that the repair makes. */
export interface RepairOffer {
  readonly file: File;
  readonly changes: readonly Diagnostic[];
}

const repairsOf = (error: Error): readonly Diagnostic[] => {
  const found = error instanceof ApiError ? error.diagnostics : [];
  return found.every(({ code }) => code === REPAIRABLE) ? found : [];
};

/** Returns functions that import a file; if the file needs a repair, the user is asked first. */
export function useImport() {
  const { t } = useTranslation('projects');
  const [offer, setOffer] = useState<RepairOffer | null>(null);
  const { mutate, isPending } = useMutation({
    mutationFn: api.importProject,
    onSuccess: (project, { file }) => {
      announceImport(project.id, file.name, project.proposal);
      navigate(projectPath(project.id));
    },
    onError: (error, { file }) => {
      const changes = repairsOf(error);
      if (changes.length > 0) setOffer({ file, changes });
      else notifications.show({ color: 'red', title: t('failed'), message: reasonOf(error) });
    },
  });
  return {
    importFile: (file: File) => mutate({ file, repair: false }),
    isImporting: isPending,
    offer,
    decline: () => setOffer(null),
    repair: () => {
      if (offer) mutate({ file: offer.file, repair: true });
      setOffer(null);
    },
  };
}
