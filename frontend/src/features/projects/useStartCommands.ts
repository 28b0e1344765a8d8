import { IconPlus, IconRobot, IconSearch, IconUpload } from '@tabler/icons-react';
import { useEffect, useEffectEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { everywhere } from '@/commands/global';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { templateText, useSortedTemplates } from './templates';

interface StartCommands {
  readonly create: (template: string) => void;
  readonly chooseFile: () => void;
  readonly search: () => void;
  readonly attach: () => void;
}

/** Registers the commands of the start page's buttons, for the command palette and for keys. */
export function useStartCommands(actions: StartCommands): void {
  const { t } = useTranslation('projects');
  const { all: templates } = useSortedTemplates();
  const create = useEffectEvent((template: string) => actions.create(template));
  const chooseFile = useEffectEvent(() => actions.chooseFile());
  const attach = useEffectEvent(() => actions.attach());
  const search = useEffectEvent(() => actions.search());
  useEffect(() => {
    const news = templates.map((template): UserCommand => ({
      id: `start.new.${template.id}`,
      group: 'project',
      labelKey: 'projects:newFrom',
      labelValues: { template: templateText(t, template, 'name') },
      icon: IconPlus,
      run: () => create(template.id),
    }));
    const others: UserCommand[] = [
      {
        id: 'start.import',
        group: 'project',
        labelKey: 'projects:import',
        icon: IconUpload,
        run: () => chooseFile(),
      },
      {
        id: 'start.attach',
        group: 'project',
        labelKey: 'attached:attach',
        icon: IconRobot,
        run: () => attach(),
      },
      {
        id: 'start.search',
        group: 'go',
        labelKey: 'projects:search',
        icon: IconSearch,
        run: () => search(),
      },
    ];
    return registerCommands([...everywhere, ...news, ...others]);
  }, [templates, t]);
}
