import { notifications } from '@mantine/notifications';
import { useMutation } from '@tanstack/react-query';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { api, type ChildOrder, type ImportChoices } from '@/api/client';
import { ApiError } from '@/api/errors';
import type { Diagnostic } from '@/api/types';
import { announceImport } from '@/store/dialogs/importReport';
import { navigate, projectPath } from '@/store/route';
import { reasonOf } from '@/api/reason';

/** The translator's code for a character that a repair would escape. */
const REPAIRABLE = 'BT0740';
/** Its codes for a tree that can be the main one of several files, and for one of several of a Python file. */
const MAIN_TREES = ['BT0924', 'BT0927'];
/** Its code for an order of children that leaves a branch out, where the other one does not. */
const ORDER = 'BT0811';

/** A file that can be imported after a repair, with the changes that the repair makes. */
export interface RepairOffer {
  readonly asked: ImportChoices;
  readonly changes: readonly Diagnostic[];
}

/** A file of several trees, one of which has to be chosen as the main tree. */
export interface MainTreeOffer {
  readonly asked: ImportChoices;
  readonly choices: readonly { readonly main: string; readonly tree: string; readonly file: string }[];
}

/** A project of JdeRobot whose own order of children leaves a branch out. */
export interface OrderOffer {
  readonly asked: ImportChoices;
  readonly finding: Diagnostic;
}

const findingsOf = (error: Error) => (error instanceof ApiError ? error.diagnostics : []);

const mainTreesOf = (error: Error): MainTreeOffer['choices'] =>
  findingsOf(error)
    .filter(({ code }) => MAIN_TREES.includes(code))
    .map(({ tree, file, values }) => ({
      main: String(values?.['choice'] ?? ''),
      tree: tree ?? String(values?.['choice'] ?? ''),
      file: file ?? '',
    }));

const repairsOf = (error: Error): readonly Diagnostic[] => {
  const found = findingsOf(error);
  return found.every(({ code }) => code === REPAIRABLE) ? found : [];
};

/** What the user is asked before a file is imported. */
interface Offers {
  readonly offer: RepairOffer | null;
  readonly mainTrees: MainTreeOffer | null;
  readonly orders: OrderOffer | null;
}

const NONE: Offers = { offer: null, mainTrees: null, orders: null };

/** Returns functions that import a file; for a repair, its main tree and its order, the user is asked first. */
export function useImport() {
  const { t } = useTranslation('projects');
  const [offers, setOffers] = useState(NONE);
  const { mutate, isPending } = useMutation({
    mutationFn: api.importProject,
    onSuccess: (project, { file }) => {
      announceImport(project.id, file.name, project.proposal, project.one_block);
      navigate(projectPath(project.id));
    },
    onError: (error, asked) => {
      const changes = repairsOf(error);
      const choices = mainTreesOf(error);
      const finding = findingsOf(error).find(({ code }) => code === ORDER);
      if (changes.length > 0) setOffers({ ...NONE, offer: { asked, changes } });
      else if (choices.length > 0) setOffers({ ...NONE, mainTrees: { asked, choices } });
      else if (finding) setOffers({ ...NONE, orders: { asked, finding } });
      else notifications.show({ color: 'red', title: t('failed'), message: reasonOf(error) });
    },
  });
  const again = (offer: { readonly asked: ImportChoices } | null, choice: Partial<ImportChoices>) => {
    if (offer) mutate({ ...offer.asked, ...choice });
    setOffers(NONE);
  };
  return {
    importFile: (file: File) => mutate({ file, repair: false, order: 'ask' }),
    isImporting: isPending,
    ...offers,
    chooseMain: (main: string) => again(offers.mainTrees, { main }),
    chooseOrder: (order: ChildOrder) => again(offers.orders, { order }),
    decline: () => setOffers(NONE),
    repair: () => again(offers.offer, { repair: true }),
  };
}
