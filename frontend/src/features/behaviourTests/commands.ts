import { IconCameraPlus, IconFlask2, IconPercentage60 } from '@tabler/icons-react';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { showCoverage, useCoverage } from '@/store/behaviourTests/coverage';
import { openMomentTest } from '@/store/dialogs/momentTest';
import { extent } from '@/store/moment/looking';
import { runTests } from '@/store/behaviourTests/report';
import { isTestFile } from '@/store/behaviourTests/useTestsAfterSave';
import { useProjectStore } from '@/store/project';

const hasTests = () => Object.keys(useProjectStore.getState().files).some(isTestFile);

const rows: readonly UserCommand[] = [
  {
    id: 'tests.run',
    group: 'project',
    labelKey: 'behaviourTests:command.run',
    icon: IconFlask2,
    enabled: hasTests,
    run: () => void runTests(),
  },
  {
    id: 'tests.moment',
    group: 'run',
    labelKey: 'behaviourTests:command.moment',
    icon: IconCameraPlus,
    enabled: () => extent() !== null && useProjectStore.getState().role !== 'viewer',
    run: openMomentTest,
  },
  {
    id: 'tests.coverage',
    group: 'canvas',
    labelKey: 'behaviourTests:command.coverage',
    icon: IconPercentage60,
    shortcut: 'Alt+KeyC',
    enabled: () => useProjectStore.getState().projectId !== null,
    run: () => showCoverage(!useCoverage.getState().isShown),
  },
];

export const registerTestCommands = () => registerCommands(rows);
